//! A folder that keeps tables: bounded, shared by many processes, and never needed.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::Tables;
use crate::contact::geometry::ContactGeometry;

/// The tables could not be kept in the folder.
#[derive(Debug, thiserror::Error)]
#[error("{}: {source}", .path.display())]
pub struct NotKept {
    /// Path of the file or folder that cannot be written.
    pub path: PathBuf,
    /// The underlying error.
    pub source: io::Error,
}

/// Tables, and whether they are kept in the folder.
#[derive(Debug)]
#[non_exhaustive]
pub struct Cached {
    /// The tables.
    pub tables: Tables,
    /// The reason if they must be computed again the next time.
    pub is_kept: Result<(), NotKept>,
}

/// Bytes of the files that a folder keeps: about eighty pairs of profiles.
const MAX_BYTES: u64 = 100_000_000;
/// Maximum number of temporary names that are tried.
const MAX_ATTEMPTS: u32 = 1000;

impl Tables {
    /// Returns the tables of [`Tables::new`]: reads them from `folder` if they were computed before, else computes
    /// them and keeps them there.
    ///
    /// A file is identified by its profiles, distances and steel; names do not matter. A file that is damaged or was
    /// written by another version is replaced. Files are written under another name first, so several programs can
    /// share a folder. When the folder holds more than 100 MB, the files that were not used for longest are removed.
    /// Where the folder cannot be written, the tables are computed all the same.
    pub fn cached(folder: &Path, geometry: ContactGeometry) -> Cached {
        let path = folder.join(Self::file_name(&geometry));
        if let Ok(bytes) = fs::read(&path)
            && let Ok(tables) = Self::from_bytes(geometry.clone(), &bytes)
        {
            // The time of the last use; where it cannot be written, the file goes earlier.
            let file = File::options().write(true).open(&path);
            let _ = file.and_then(|file| file.set_modified(SystemTime::now()));
            let is_kept = Ok(());
            return Cached { tables, is_kept };
        }
        let tables = Self::new(geometry);
        let is_kept = keep(folder, &path, &tables.to_bytes());
        Cached { tables, is_kept }
    }
}

fn keep(folder: &Path, path: &Path, bytes: &[u8]) -> Result<(), NotKept> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |source| NotKept { path, source }
    };
    fs::create_dir_all(folder).map_err(failed(folder))?;
    write_whole(path, bytes).map_err(failed(path))?;
    trim(folder).map_err(failed(folder))
}

/// Removes the files that were not used for longest until the folder holds no more than [`MAX_BYTES`].
fn trim(folder: &Path) -> io::Result<()> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let extension = path.extension().and_then(|extension| extension.to_str());
        // Another process may remove a file at any time.
        if let (Some("tables" | "part"), Ok(data)) = (extension, fs::metadata(&path)) {
            files.push((data.modified()?, data.len(), path));
        }
    }
    files.sort();
    let mut bytes: u64 = files.iter().map(|(_, bytes, _)| bytes).sum();
    for (_, of_file, path) in files {
        if bytes <= MAX_BYTES {
            break;
        }
        let _ = fs::remove_file(path);
        bytes -= of_file;
    }
    Ok(())
}

/// Writes a file under a temporary name in the same folder and renames it.
fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A name that exists belongs to another process, possibly on another machine, or was left by one that crashed.
    let mut attempt = 0_u32;
    let (temporary, mut file) = loop {
        let temporary = path.with_extension(format!("{}-{attempt}.part", std::process::id()));
        match File::create_new(&temporary) {
            Ok(file) => break (temporary, file),
            Err(error)
                if error.kind() == io::ErrorKind::AlreadyExists && attempt < MAX_ATTEMPTS =>
            {
                attempt += 1;
            }
            Err(error) => return Err(error),
        }
    };
    let written = file.write_all(bytes);
    drop(file);
    let written = written.and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // The write error is reported; an error of the removal is ignored.
        let _ = fs::remove_file(&temporary);
    }
    written
}
