//! Reading: a file by its name, or standard input for `-`.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use super::FileError;

/// Stands for standard input or standard output in place of a file; a file of this name is `./-`.
pub const STANDARD_STREAM: &str = "-";

/// Whether `path` is `-`.
pub fn is_standard_stream(path: &Path) -> bool {
    path == Path::new(STANDARD_STREAM)
}

/// Whether `name` can only be a file's: `-`, a name with a folder, or one with an extension. Any other
/// name may be one of the program's own.
pub fn is_file_name(name: &Path) -> bool {
    is_standard_stream(name) || name.extension().is_some() || name.components().count() > 1
}

/// `path` as messages call it.
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
/// There is no such file, it is a folder, or it may not be read.
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

/// All bytes of `path`.
///
/// # Errors
/// As [`open`].
pub fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    open(path)?
        .read_to_end(&mut bytes)
        .map_err(|error| cannot_read(path, error))?;
    Ok(bytes)
}

/// All text of `path`.
///
/// # Errors
/// As [`open`], or bytes that are not UTF-8.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(read(path)?).map_err(|error| {
        let reason = format!("not UTF-8 text: {}", error.utf8_error());
        cannot_read(path, io::Error::new(io::ErrorKind::InvalidData, reason))
    })
}

/// Bytes in the file at `path`, for a progress bar; 0 where that is not known.
pub fn length(path: &Path) -> u64 {
    if is_standard_stream(path) {
        return 0;
    }
    std::fs::metadata(path).map_or(0, |data| data.len())
}

fn cannot_read(path: &Path, error: io::Error) -> FileError {
    FileError::read(&name(path), error)
}
