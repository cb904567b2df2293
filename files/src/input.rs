//! Reads files; `-` means standard input.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::FileError;

/// Path that means standard input or standard output. Write `./-` for a file with this name.
pub const STANDARD_STREAM: &str = "-";

/// True if `path` is `-`.
pub fn is_standard_stream(path: &Path) -> bool {
    path == Path::new(STANDARD_STREAM)
}

/// True if `name` can only be a file name: `-`, a path with a directory, or a name with an extension. Any other name
/// may also be a built-in name.
pub fn is_file_name(name: &Path) -> bool {
    is_standard_stream(name) || name.extension().is_some() || name.components().count() > 1
}

/// Name of an input in messages.
pub fn name(path: &Path) -> Cow<'_, Path> {
    if is_standard_stream(path) {
        Cow::Borrowed(Path::new("standard input"))
    } else {
        Cow::Borrowed(path)
    }
}

/// Opens `path` for reading.
///
/// # Errors
/// Returns an error if the file does not exist, is a directory or cannot be read.
pub fn open(path: &Path) -> Result<Box<dyn Read>, FileError> {
    if is_standard_stream(path) {
        return Ok(Box::new(io::stdin().lock()));
    }
    let file = File::open(path).map_err(|error| cannot_read(path, error))?;
    let data = file.metadata().map_err(|error| cannot_read(path, error))?;
    if data.is_dir() {
        let folder = io::Error::new(io::ErrorKind::IsADirectory, "it is a folder");
        return Err(cannot_read(path, folder));
    }
    Ok(Box::new(file))
}

/// Reads all bytes of `path`.
///
/// # Errors
/// Same errors as [`open`].
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    open(path)?
        .read_to_end(&mut bytes)
        .map_err(|error| cannot_read(path, error))?;
    Ok(bytes)
}

/// Reads all text of `path`.
///
/// # Errors
/// Same errors as [`open`]; also an error if the bytes are not UTF-8.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(read(path)?).map_err(|error| {
        let reason = format!("not UTF-8 text: {}", error.utf8_error());
        cannot_read(path, io::Error::new(io::ErrorKind::InvalidData, reason))
    })
}

/// Size of the file at `path` in bytes, for a progress bar; 0 if unknown.
pub fn length(path: &Path) -> u64 {
    if is_standard_stream(path) {
        return 0;
    }
    std::fs::metadata(path).map_or(0, |data| data.len())
}

fn cannot_read(path: &Path, error: io::Error) -> FileError {
    FileError::read(&name(path), error)
}
