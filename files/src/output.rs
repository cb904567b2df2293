//! Writes files, each completely or not at all; `-` means standard output.

use std::borrow::Cow;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::FileError;
use super::input::is_standard_stream;
use super::temporary::Temporary;

/// Name of an output in messages.
pub fn name(path: &Path) -> Cow<'_, Path> {
    if is_standard_stream(path) {
        Cow::Borrowed(Path::new("standard output"))
    } else {
        Cow::Borrowed(path)
    }
}

/// Error for an output that cannot be written.
pub fn cannot_write(path: &Path, source: impl Into<io::Error>) -> FileError {
    FileError::Write {
        path: name(path).into_owned(),
        source: source.into(),
    }
}

/// Error for CSV rows that cannot be written to `path`.
pub fn cannot_write_rows(path: &Path, error: csv::Error) -> FileError {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => cannot_write(path, error),
        other => cannot_write(path, io::Error::other(format!("{other:?}"))),
    }
}

/// Calls [`write_whole`] if there is a path, and passes path and file to `write`; otherwise calls `write` with `None`.
///
/// # Errors
/// Same errors as [`write_whole`].
pub fn write_whole_if<T, E: From<FileError>>(
    path: Option<&Path>,
    write: impl FnOnce(Option<(&Path, &mut dyn Write)>) -> Result<T, E>,
) -> Result<T, E> {
    match path {
        Some(path) => write_whole(path, |file| write(Some((path, file)))),
        None => write(None),
    }
}

/// Creates the file at `path` with the content that `write` writes to it, and returns the value of `write`.
///
/// The file appears under its name only if `write` succeeds; otherwise an existing file stays unchanged. Symbolic links
/// are followed. Standard output (`-`), devices and pipes cannot be replaced and are written directly.
///
/// # Errors
/// Returns the error of `write`, or an error if the directory cannot be written.
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
    let (pending, result) = PendingFile::new(path, write)?;
    pending.rename()?;
    Ok(result)
}

/// True if `path` is a regular file or does not exist; false for standard output, devices and pipes.
pub fn is_replaceable(path: &Path) -> bool {
    !is_standard_stream(path) && std::fs::metadata(path).map_or(true, |old| old.is_file())
}

/// A complete file under a temporary name; deleted on drop unless [`Self::rename`] was called.
struct PendingFile<'a> {
    path: &'a Path,
    target: PathBuf,
    temporary: Temporary,
}

impl<'a> PendingFile<'a> {
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
        let pending = Self {
            path,
            target,
            temporary,
        };
        Ok((pending, result))
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

/// Writes `bytes` to `path`, completely or not at all.
///
/// # Errors
/// Returns an error if the file cannot be written.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    write_whole(path, |file| write_all(file, path, bytes))
}

/// Writes files that belong together: none appears under its name before all are written.
///
/// # Errors
/// Returns an error if a file cannot be written, or if it exists and is not a regular file.
pub fn write_together(files: &[(&Path, &[u8])]) -> Result<(), FileError> {
    let pending: Vec<PendingFile<'_>> = files
        .iter()
        .map(|&(path, bytes)| {
            if is_replaceable(path) {
                let (pending, ()) = PendingFile::new(path, |file| write_all(file, path, bytes))?;
                Ok(pending)
            } else {
                Err(cannot_write(path, io::Error::other("it is not a file")))
            }
        })
        .collect::<Result<_, _>>()?;
    pending.into_iter().try_for_each(PendingFile::rename)
}

fn write_all(file: &mut dyn Write, path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    file.write_all(bytes)
        .map_err(|error| cannot_write(path, error))
}

/// Creates a directory and its missing parents.
///
/// # Errors
/// Returns an error if the directory cannot be created.
pub fn create_folder(folder: &Path) -> Result<(), FileError> {
    std::fs::create_dir_all(folder).map_err(|source| FileError::Folder {
        path: folder.to_owned(),
        source,
    })
}

/// Writes each file, given as name and text, into `folder`, creating it if necessary; returns the paths.
///
/// # Errors
/// Returns an error if the directory cannot be created or a file cannot be written.
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

/// Temporary files are private to their owner; results are readable by everyone who can read the directory.
#[cfg(unix)]
fn make_readable(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &File) -> io::Result<()> {
    Ok(())
}
