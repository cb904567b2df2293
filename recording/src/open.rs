//! The rows of a file, by its kind.

#[cfg(any(feature = "mdf", feature = "parquet"))]
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::RecordingError;
use super::channels::Channels;
#[cfg(feature = "mdf")]
use super::mdf::Mdf;
use super::opened::Opened;
#[cfg(feature = "parquet")]
use super::parquet::Parquet;
use super::rows::Rows;
use super::select::{label, select};
use super::stream::{Kind, Stream};
use super::text::Text;
use super::unit::Quantity;
use dashpot_files::{FileError, input};

/// Where a recording comes from.
pub(super) enum Origin<'a> {
    /// A file, or standard input.
    Path(&'a Path),
    /// Bytes, and what errors call them.
    Stream(&'a Path, Box<dyn Read>),
}

/// Finds the channels of a file.
///
/// # Errors
/// It cannot be read, is damaged or is of another kind.
pub(super) fn open(origin: Origin<'_>, channels: &Channels) -> Result<Box<dyn Opened>, FileError> {
    let (name, file, source) = match origin {
        Origin::Path(path) => (input::name(path), Some(path), input::open(path)?),
        Origin::Stream(name, source) => (name.into(), None, source),
    };
    // Only what is jumped in needs the file itself.
    #[cfg(not(any(feature = "mdf", feature = "parquet")))]
    let _ = file;
    let path: &Path = &name;
    let in_file = |error: RecordingError| FileError::in_file(path, error);
    let failed = |error: io::Error| FileError::read(path, error);
    let stream = Stream::new(source).map_err(failed)?;
    match stream.kind() {
        Kind::Text => Ok(Box::new(Text::open(path, stream, &channels.text)?)),
        #[cfg(feature = "mdf")]
        Kind::Mdf4 => {
            let file = seekable(stream, file).map_err(failed)?;
            Ok(Box::new(Mdf::open(path, file)?))
        }
        #[cfg(feature = "parquet")]
        Kind::Parquet => {
            let file = seekable(stream, file).map_err(failed)?;
            Ok(Box::new(Parquet::open(path, file)?))
        }
        #[cfg(not(feature = "mdf"))]
        Kind::Mdf4 => Err(in_file(RecordingError::Feature {
            kind: "MDF4",
            feature: "mdf",
        })),
        #[cfg(not(feature = "parquet"))]
        Kind::Parquet => Err(in_file(RecordingError::Feature {
            kind: "Parquet",
            feature: "parquet",
        })),
        Kind::Other(kind) => Err(in_file(RecordingError::Kind { kind })),
    }
}

/// Rows of the channels of `quantities`, the first of which is the time.
///
/// # Errors
/// As [`open`]; a channel that is missing or may be several, or its unit.
pub(super) fn open_rows<const N: usize>(
    origin: Origin<'_>,
    channels: &Channels,
    quantities: [Quantity; N],
) -> Result<Rows<N>, FileError> {
    let path = match &origin {
        Origin::Path(path) => input::name(path).into_owned(),
        Origin::Stream(name, _) => (*name).to_owned(),
    };
    let mut opened = open(origin, channels)?;
    let chosen = select(opened.found(), opened.groups(), channels, quantities)
        .map_err(|error| FileError::in_file(&path, error))?;
    let names = chosen.map(|chosen| label(opened.found(), chosen.index));
    let rows = opened.rows(&chosen.map(|chosen| chosen.index), false)?;
    Ok(Rows::new(&path, rows, names, chosen, channels.skip_invalid))
}

/// The stream as a file to jump in: the file itself where it is one, else a temporary copy.
#[cfg(any(feature = "mdf", feature = "parquet"))]
fn seekable(stream: Stream, file: Option<&Path>) -> io::Result<File> {
    use std::io::Seek;
    if let Some(path) = file.filter(|path| !stream.is_compressed() && path.is_file()) {
        return File::open(path);
    }
    let mut copy = tempfile::tempfile()?;
    io::copy(&mut stream.into_reader(), &mut copy)?;
    copy.rewind()?;
    Ok(copy)
}
