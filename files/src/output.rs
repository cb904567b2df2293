//! Writing: files whole or not at all, or standard output for `-`.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::FileError;
use super::input::is_standard_stream;
use super::temporary::Temporary;

/// `path` as messages call it.
pub fn name(path: &Path) -> Cow<'_, Path> {
    if is_standard_stream(path) {
        Cow::Borrowed(Path::new("standard output"))
    } else {
        Cow::Borrowed(path)
    }
}

/// `path` cannot be written.
pub fn cannot_write(path: &Path, source: impl Into<io::Error>) -> FileError {
    FileError::Write {
        path: name(path).into_owned(),
        source: source.into(),
    }
}

/// Rows of CSV cannot be written to `path`.
pub fn cannot_write_rows(path: &Path, error: csv::Error) -> FileError {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => cannot_write(path, error),
        other => cannot_write(path, io::Error::other(format!("{other:?}"))),
    }
}

/// As [`write_whole`] where there is a path, which `write` is given with the file; without one `write` is
/// called all the same.
///
/// # Errors
/// As [`write_whole`].
pub fn write_whole_if<T, E: From<FileError>>(
    path: Option<&Path>,
    write: impl FnOnce(Option<(&Path, &mut dyn Write)>) -> Result<T, E>,
) -> Result<T, E> {
    match path {
        Some(path) => write_whole(path, |file| write(Some((path, file)))),
        None => write(None),
    }
}

/// Writes `path` through `write`; the file appears under its name only when `write` succeeded,
/// and a file already there stays untouched otherwise. Returns what `write` returns. A link is followed; standard output (`-`), a
/// device or a pipe, which cannot be replaced, is written to as it stands.
///
/// # Errors
/// What `write` returns, or the folder cannot be written.
pub fn write_whole<T, E: From<FileError>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<T, E>,
) -> Result<T, E> {
    if is_standard_stream(path) {
        return write_through(path, io::stdout().lock(), write);
    }
    if !is_replaceable(path) {
        let file = File::options().write(true).open(path);
        let file = file.map_err(|error| cannot_write(path, error))?;
        return write_through(path, file, write);
    }
    let (written, result) = Written::new(path, write)?;
    written.rename()?;
    Ok(result)
}

/// Whether `path` names a file that is or may be there, not standard output, a device or a pipe.
pub fn is_replaceable(path: &Path) -> bool {
    !is_standard_stream(path) && std::fs::metadata(path).map_or(true, |old| old.is_file())
}

/// A file written whole that has not got its name yet; without [`Self::rename`] it goes.
struct Written<'a> {
    path: &'a Path,
    target: PathBuf,
    temporary: Temporary,
}

impl<'a> Written<'a> {
    fn new<T, E: From<FileError>>(
        path: &'a Path,
        write: impl FnOnce(&mut dyn Write) -> Result<T, E>,
    ) -> Result<(Self, T), E> {
        let failed = |error: io::Error| cannot_write(path, error);
        let old = std::fs::metadata(path).ok();
        let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let folder = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        if !folder.is_dir() {
            let reason = format!("there is no folder {}", folder.display());
            return Err(failed(io::Error::new(io::ErrorKind::NotFound, reason)).into());
        }
        let temporary = Temporary::new(folder).map_err(failed)?;
        let file = temporary.file().map_err(failed)?;
        let result = write_through(path, file, write)?;
        match old {
            Some(old) => file.set_permissions(old.permissions()),
            None => make_readable(file),
        }
        .map_err(failed)?;
        let written = Self {
            path,
            target,
            temporary,
        };
        Ok((written, result))
    }

    fn rename(self) -> Result<(), FileError> {
        self.temporary
            .rename(&self.target)
            .map_err(|error| cannot_write(self.path, error))
    }
}

fn write_through<T, E: From<FileError>>(
    path: &Path,
    writer: impl Write,
    write: impl FnOnce(&mut dyn Write) -> Result<T, E>,
) -> Result<T, E> {
    let mut writer = BufWriter::new(writer);
    let result = write(&mut writer)?;
    writer.flush().map_err(|error| cannot_write(path, error))?;
    Ok(result)
}

/// Writes `bytes` to `path`, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    write_whole(path, |file| write_all(file, path, bytes))
}

/// Writes files that belong together: no one gets its name before all are written.
///
/// # Errors
/// One cannot be written, or is there and not a file.
pub fn write_together(files: &[(&Path, &[u8])]) -> Result<(), FileError> {
    let written: Vec<Written<'_>> = files
        .iter()
        .map(|&(path, bytes)| {
            if is_replaceable(path) {
                let (written, ()) = Written::new(path, |file| write_all(file, path, bytes))?;
                Ok(written)
            } else {
                Err(cannot_write(path, io::Error::other("it is not a file")))
            }
        })
        .collect::<Result<_, _>>()?;
    written.into_iter().try_for_each(Written::rename)
}

fn write_all(file: &mut dyn Write, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    file.write_all(bytes)
        .map_err(|error| cannot_write(path, error))
}

/// Makes a folder and those above it, where they are missing.
///
/// # Errors
/// It cannot be made.
pub fn create_folder(folder: &Path) -> Result<(), FileError> {
    std::fs::create_dir_all(folder).map_err(|source| FileError::Folder {
        path: folder.to_owned(),
        source,
    })
}

/// Writes each file, a name and its text, into `folder`, made where it is missing; the paths of the files.
///
/// # Errors
/// The folder cannot be made or a file not be written.
pub fn write_folder(folder: &Path, files: &[(&str, String)]) -> Result<Vec<String>, FileError> {
    create_folder(folder)?;
    files
        .iter()
        .map(|(name, text)| {
            let path = folder.join(name);
            write_bytes(&path, text.as_bytes())?;
            Ok(path.display().to_string())
        })
        .collect()
}

/// A temporary file is private to its owner; a result is for everyone who may read the folder.
#[cfg(unix)]
fn make_readable(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &File) -> io::Result<()> {
    Ok(())
}
