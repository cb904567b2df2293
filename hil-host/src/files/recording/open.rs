//! The rows of a file, by its kind.

use std::io::Read;
use std::path::Path;

use super::RecordingError;
use super::channels::Channels;
use super::rows::Rows;
use super::select::{label, select};
use super::stream::{Kind, Stream};
use super::text::Text;
use super::unit::Quantity;
use crate::files::FileError;

/// Rows of the channels of `quantities`, the first of which is the time.
///
/// # Errors
/// A file that cannot be read, is of another kind, or lacks a channel or its unit.
pub(super) fn open_rows<const N: usize>(
    path: &Path,
    source: Box<dyn Read>,
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<Rows<N>, FileError> {
    let in_file = |error: RecordingError| FileError::in_file(path, error);
    let stream = Stream::new(source).map_err(|error| FileError::read(path, error))?;
    match stream.kind() {
        Kind::Text => {
            let text = Text::open(path, stream, &channels.text)?;
            let chosen = select(text.found(), &[], channels, quantities).map_err(in_file)?;
            let names = chosen.map(|chosen| label(text.found(), chosen.index));
            let rows = text.rows(&chosen.map(|chosen| chosen.index))?;
            let rows = Box::new(rows);
            Ok(Rows::new(path, rows, names, chosen, channels.skip_invalid))
        }
        Kind::Mdf4 => Err(in_file(RecordingError::Feature {
            kind: "MDF4",
            feature: "mdf",
        })),
        Kind::Parquet => Err(in_file(RecordingError::Feature {
            kind: "Parquet",
            feature: "parquet",
        })),
        Kind::Other(kind) => Err(in_file(RecordingError::Kind { kind })),
    }
}
