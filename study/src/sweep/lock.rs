//! Lock of a file to which one process at a time may add rows.

use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Opens the file at `path` with a lock, so that no other process can add to it.
pub(super) fn locked(path: &Path) -> Result<File, FileError> {
    loop {
        let file = File::options()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)
            .map_err(|error| cannot_write(path, error))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let other = "another process is adding rows to it";
                return Err(cannot_write(path, io::Error::other(other)));
            }
            Err(TryLockError::Error(error)) => return Err(cannot_write(path, error)),
        }
        // Between opening and locking, a finishing process may have removed the file, and another may have created a
        // new one.
        if is_at(&file, path) {
            return Ok(file);
        }
    }
}

/// True if `file` is the file at `path`.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (file.metadata(), path.metadata()) {
        (Ok(this), Ok(there)) => (this.dev(), this.ino()) == (there.dev(), there.ino()),
        _ => false,
    }
}

/// True if there is a file at `path`; on these systems an open file keeps its name.
#[cfg(not(unix))]
fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(all(test, unix))]
mod tests {
    use std::fs::{self, File};

    use super::is_at;

    #[test]
    fn a_removed_file_differs_from_its_successor_at_the_same_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("rows.csv.partial");
        let first = File::create(&path).unwrap();
        assert!(is_at(&first, &path));
        fs::remove_file(&path).unwrap();
        assert!(!is_at(&first, &path));
        let second = File::create(&path).unwrap();
        assert!(is_at(&second, &path));
        assert!(!is_at(&first, &path));
    }
}
