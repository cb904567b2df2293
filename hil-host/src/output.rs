//! Files written whole or not at all.

use std::io::{BufWriter, Write};
use std::path::Path;

use crate::failure::{Failure, Outcome};

/// Writes `path` through `write`; the file appears under its name only when `write` succeeded,
/// and a file already there stays untouched otherwise. A link is followed; a device or a pipe, which
/// cannot be replaced, is written to as it stands.
///
/// # Errors
/// What `write` returns, or the folder cannot be written.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&std::fs::File>) -> Outcome<()>,
) -> Outcome<()> {
    let failed = |error: std::io::Error| Failure::in_file(path, format!("cannot write: {error}"));
    let old = std::fs::metadata(path).ok();
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        let file = std::fs::File::options()
            .write(true)
            .open(path)
            .map_err(failed)?;
        let mut writer = BufWriter::new(&file);
        write(&mut writer)?;
        return writer.flush().map_err(failed);
    }
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let message = format!("cannot write: there is no folder {}", folder.display());
        return Err(Failure::in_file(path, message));
    }
    let file = tempfile::Builder::new()
        .prefix(".dashpot-")
        .tempfile_in(folder)
        .map_err(failed)?;
    let mut writer = BufWriter::new(file.as_file());
    write(&mut writer)?;
    writer.flush().map_err(failed)?;
    drop(writer);
    file.persist(&target).map_err(|error| failed(error.error))?;
    match old {
        Some(old) => std::fs::set_permissions(&target, old.permissions()),
        None => make_readable(&target),
    }
    .map_err(failed)
}

/// Writes `bytes` to `path`, whole or not at all.
///
/// # Errors
/// The file cannot be written.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Outcome<()> {
    write_whole(path, |file| {
        file.write_all(bytes)
            .map_err(|error| Failure::in_file(path, format!("cannot write: {error}")))
    })
}

/// Writes each file, a name and its text, into `folder`, made where it is missing, and tells their
/// paths.
///
/// # Errors
/// The folder cannot be made or a file not be written.
pub fn write_folder(folder: &Path, files: &[(&str, String)]) -> Outcome<Vec<String>> {
    std::fs::create_dir_all(folder)
        .map_err(|error| Failure::in_file(folder, format!("cannot make the folder: {error}")))?;
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
fn make_readable(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(path, std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &Path) -> std::io::Result<()> {
    Ok(())
}
