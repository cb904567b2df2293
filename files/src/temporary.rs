//! Files that are not whole yet: under a name of their own, deleted when their writing fails or the
//! command is interrupted.

use std::collections::BTreeSet;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

/// The temporary files. A thread that makes, renames or deletes one holds the lock while it does, so
/// that an interruption finds each of them either in the list or gone.
static PATHS: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn paths() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    PATHS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file, deleted when dropped.
pub(crate) struct Temporary(Option<NamedTempFile>);

impl Temporary {
    /// A new one in `folder`, for its owner only.
    pub(crate) fn new(folder: &Path) -> io::Result<Self> {
        let mut paths = paths();
        let file = Builder::new().prefix(".dashpot-").tempfile_in(folder)?;
        paths.insert(file.path().to_owned());
        Ok(Self(Some(file)))
    }

    /// The open file.
    pub(crate) fn file(&self) -> io::Result<&File> {
        let file = self.0.as_ref().ok_or(io::ErrorKind::NotFound)?;
        Ok(file.as_file())
    }

    /// Gives the file its name, in place of one already there.
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
            // There is no one to report an error to.
            let _ = file.close();
        }
    }
}

/// Deletes all temporary files; no file can be made while the returned guard lives.
pub fn delete_all() -> impl Drop {
    let paths = paths();
    for path in &*paths {
        // Nothing more can be done for one that cannot be deleted.
        let _ = std::fs::remove_file(path);
    }
    paths
}
