//! Temporary files for incomplete output, deleted if writing fails or the program is interrupted.

use std::collections::BTreeSet;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// Paths of all temporary files. A thread holds the lock while it creates, renames or deletes one, so that on an
/// interruption each file is either listed or already gone.
static PATHS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn paths() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    PATHS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Temporary file, deleted on drop.
pub(crate) struct Temporary(Option<NamedTempFile>);

impl Temporary {
    /// Creates a file in `folder` that only its owner can read.
    pub(crate) fn new(folder: &Path) -> io::Result<Self> {
        let mut paths = paths();
        let file = Builder::new().prefix(".dashpot-").tempfile_in(folder)?;
        paths.insert(file.path().to_owned());
        Ok(Self(Some(file)))
    }

    /// Returns the open file.
    pub(crate) fn file(&self) -> io::Result<&File> {
        let file = self.0.as_ref().ok_or(io::ErrorKind::NotFound)?;
        Ok(file.as_file())
    }

    /// Renames the file to `target`, replacing an existing file.
    pub(crate) fn rename(mut self, target: &Path) -> io::Result<()> {
        let mut paths = paths();
        let file = self.0.take().ok_or(io::ErrorKind::NotFound)?;
        paths.remove(file.path());
        file.persist(target).map_err(|error| error.error)?;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let mut paths = paths();
            paths.remove(file.path());
            // `drop` cannot report an error.
            let _ = file.close();
        }
    }
}

/// Deletes all temporary files. No new one can be created while the returned guard is alive.
pub fn delete_all() -> impl Drop {
    let paths = paths();
    for path in &*paths {
        // A file that cannot be deleted is left behind.
        let _ = std::fs::remove_file(path);
    }
    paths
}
