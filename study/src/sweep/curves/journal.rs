//! Curves of a running study. The lock of the journal of rows protects their files.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

use super::file::{KeptCurves, KnownRows, append, header, row_digest, write};
use super::{Curves, Needed, is_needed, path_of, with_ending};
use crate::sweep::rows::Rows;
use crate::sweep::study::Study;

/// Curves computed so far, and the file to which new ones are added.
#[derive(Debug)]
pub struct CurveJournal {
    path: PathBuf,
    partial: PathBuf,
    /// `None` before the first curve of this run.
    file: Option<File>,
    kept: KeptCurves,
    /// True if the file at `path` has all curves and nothing else.
    is_written: bool,
}

impl CurveJournal {
    /// Opens the curves beside the file of `rows` at `path_of_rows`, and those of an interrupted run. With `restart`,
    /// it starts without curves and renames an existing file to `.old`.
    ///
    /// # Errors
    /// Returns an error if a file cannot be renamed or removed.
    pub fn open(
        known: KnownRows<'_>,
        path_of_rows: &Path,
        restart: bool,
    ) -> Result<Self, FileError> {
        let path = path_of(path_of_rows);
        let partial = with_ending(&path, "partial");
        let mut kept = KeptCurves::default();
        let mut is_written = true;
        if restart {
            if path.exists() {
                let old = with_ending(&path, "old");
                fs::rename(&path, &old).map_err(|error| cannot_write(&old, error))?;
            }
            remove(&partial)?;
        } else {
            kept = known.read(&path);
            let added = known.read_partial(&partial);
            is_written = kept.problems.is_empty() && !partial.exists();
            kept.curves.extend(added.curves);
            kept.problems.extend(added.problems);
        }
        Ok(Self {
            path,
            partial,
            file: None,
            kept,
            is_written,
        })
    }

    /// Keeps only `needed` curves, as if no case had run for an earlier study.
    pub fn retain(&mut self, needed: &Needed) {
        self.kept.curves.retain(|key, _| is_needed(needed, key));
        self.is_written = false;
    }

    /// Adds curves of a case; `digest` is the digest of its row.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn add(&mut self, digest: &str, curves: Curves) -> Result<(), FileError> {
        if curves.is_empty() {
            return Ok(());
        }
        let failed = |error: io::Error| cannot_write(&self.partial, error);
        let mut lines = Vec::new();
        for (key, curve) in &curves {
            append(&mut lines, digest, key, curve).map_err(failed)?;
        }
        let file = match &mut self.file {
            Some(file) => file,
            slot => slot.insert(continued(&self.partial).map_err(failed)?),
        };
        file.write_all(&lines).map_err(failed)?;
        self.kept.curves.extend(curves);
        self.is_written = false;
        Ok(())
    }

    /// Writes all curves to their file, unless it has them already.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn write(&self, study: &Study, rows: &Rows) -> Result<(), FileError> {
        if self.is_written {
            return Ok(());
        }
        match self.kept.curves.is_empty() {
            true => remove(&self.path),
            false => write(study, rows, &self.kept.curves, &self.path),
        }
    }

    /// Removes the file of an unfinished run; returns the curves, and what was wrong with others.
    ///
    /// # Errors
    /// Returns an error if the file cannot be removed.
    pub fn end(self) -> Result<(Curves, Vec<String>), FileError> {
        drop(self.file);
        remove(&self.partial)?;
        Ok((self.kept.curves, self.kept.problems))
    }

    /// Removes the curves of these cases, which must be in ascending order.
    ///
    /// # Errors
    /// Returns an error if the file cannot be written.
    pub fn remove(&mut self, study: &Study, rows: &Rows, cases: &[u64]) -> Result<(), FileError> {
        let is_kept = |case: &u64| cases.binary_search(case).is_err();
        self.kept.curves.retain(|key, _| is_kept(&key.case));
        self.file = None;
        remove(&self.partial)?;
        for (key, curve) in std::mem::take(&mut self.kept.curves) {
            if let Some(digest) = row_digest(study, rows, key.case) {
                self.add(&digest, Curves::from([(key, curve)]))?;
            }
        }
        Ok(())
    }
}

/// Opens the file of an unfinished run after its last whole line, with a header if it is new.
fn continued(partial: &Path) -> io::Result<File> {
    let bytes = match fs::read(partial) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        bytes => bytes.unwrap_or_default(),
    };
    let mut file = File::options().append(true).create(true).open(partial)?;
    let end = bytes.iter().rposition(|byte| *byte == b'\n');
    let end = end.filter(|_| bytes.starts_with(header().as_bytes()));
    file.set_len(end.map_or(0, |end| end as u64 + 1))?;
    if end.is_none() {
        file.write_all(header().as_bytes())?;
    }
    Ok(file)
}

/// Removes a file that may be missing.
fn remove(path: &Path) -> Result<(), FileError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(cannot_write(path, error)),
        _ => Ok(()),
    }
}
