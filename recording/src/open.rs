//! Opens a file according to its format.

#[cfg(any(feature = "mdf", feature = "parquet"))]
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::RecordingError;
use super::channels::Channels;
use super::groups::{Selection, select_groups};
use super::interpolated::{Force, Interpolated, NamedChannel};
#[cfg(feature = "mdf")]
use super::mdf::Mdf;
#[cfg(feature = "parquet")]
use super::parquet::Parquet;
use super::recording_file::RecordingFile;
use super::rows::Rows;
use super::select::{SelectedChannel, group_label, label};
use super::stream::{Kind, Stream};
use super::text::Text;
use super::unit::Quantity;
use dashpot_files::{FileError, input};

/// Origin of a recording.
pub(super) enum Origin<'a> {
    /// A file, or standard input.
    Path(&'a Path),
    /// A stream of bytes, and its name in errors.
    Stream(&'a Path, Box<dyn Read>),
}

/// Opens a file and finds its channels.
///
/// # Errors
/// Returns an error if the file is unreadable, damaged or in an unsupported format.
pub(super) fn open(
    origin: Origin<'_>,
    channels: &Channels,
) -> Result<Box<dyn RecordingFile>, FileError> {
    let (name, file, source) = match origin {
        Origin::Path(path) => (input::name(path), Some(path), input::open(path)?),
        Origin::Stream(name, source) => (name.into(), None, source),
    };
    // Only formats with random access need the file itself.
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

/// Opens the rows of the channels of `quantities`. The first quantity is the time.
///
/// # Errors
/// Same errors as [`open`]; also an error if a channel is missing or ambiguous, or its unit is unknown.
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
    let Selection { chosen, apart } =
        select_groups(opened.found(), opened.groups(), channels, quantities)
            .map_err(|error| FileError::in_file(&path, error))?;
    let names = chosen.map(|chosen| label(opened.found(), chosen.index));
    let rows = match apart {
        None => opened.rows(&chosen.map(|chosen| chosen.index), false)?,
        Some((time, position)) => {
            let force = chosen[position];
            let named = |chosen: SelectedChannel| NamedChannel {
                name: label(opened.found(), chosen.index),
                chosen,
            };
            let grouped = |channel: SelectedChannel| {
                let group = opened.found()[channel.index].group;
                (group, group_label(opened.groups(), group))
            };
            let (named_time, named_force) = (named(time), named(force));
            let groups = [grouped(chosen[0]), grouped(force)];
            let mut own = chosen.map(|chosen| chosen.index).to_vec();
            own.remove(position);
            let main = opened.rows(&own, false)?;
            let force = Force {
                source: opened.rows(&[time.index, force.index], false)?,
                time: named_time,
                force: named_force,
                skip_invalid: channels.skip_invalid,
                position,
            };
            Box::new(Interpolated::new(&path, main, chosen[0], N, force, groups))
        }
    };
    Ok(Rows::new(&path, rows, names, chosen, channels.skip_invalid))
}

/// Returns the stream as a file with random access: the file itself if possible, otherwise a temporary copy.
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
