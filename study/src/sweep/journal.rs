//! Rows of a running study, written one by one so that an interruption loses none.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::curves::{CurveJournal, Curves, with_ending};
use super::row::Row;
use super::rows::{self, Rows, RowsError};
use super::study::{Shard, Study};
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// Rows computed so far with the curves of their cases, and the files to which new ones are added: the files of rows
/// and curves with `.partial` appended to their names.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    partial: PathBuf,
    file: File,
    rows: Rows,
    curves: CurveJournal,
}

/// Rows and curves of a whole study or shard.
#[derive(Debug)]
pub struct Finished {
    /// Rows by case number.
    pub rows: Rows,
    /// Curves of the cases.
    pub curves: Curves,
    /// What was wrong with curves from earlier runs, which were left out.
    pub problems: Vec<String>,
}

impl Journal {
    /// Opens the rows of the file at `path` and of an interrupted run, with their curves. With `restart`, it starts
    /// without rows and renames existing files to `.old`.
    ///
    /// # Errors
    /// Returns an error if a file cannot be read or written, if it contains rows of another study or shard, or if
    /// another process is adding rows.
    pub fn open(
        study: &Study,
        path: &Path,
        shard: Option<Shard>,
        restart: bool,
    ) -> Result<Self, RowsError> {
        let partial = with_ending(path, "partial");
        let mut file = locked(&partial)?;
        let mut known = Rows::new();
        if restart {
            file.set_len(0)
                .map_err(|error| cannot_write(&partial, error))?;
            if path.exists() {
                let old = with_ending(path, "old");
                fs::rename(path, &old).map_err(|error| cannot_write(&old, error))?;
            }
        } else {
            if path.exists() {
                known = rows::read_once(study, path)?;
            }
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes)
                .map_err(|error| FileError::read(&partial, error))?;
            // An incomplete last line was being written when the process ended.
            let last_newline = bytes.iter().rposition(|byte| *byte == b'\n');
            bytes.truncate(last_newline.map_or(0, |last| last + 1));
            if bytes.trim_ascii().is_empty() {
                bytes.clear();
            }
            if !bytes.is_empty() {
                let read = rows::parse(study, &partial, &bytes)?;
                known.extend(rows::index_by_case(&partial, read)?);
            }
            file.set_len(bytes.len() as u64)
                .map_err(|error| cannot_write(&partial, error))?;
            let is_foreign = |case: &&u64| shard.is_some_and(|shard| !shard.contains(**case));
            if let (Some(case), Some(shard)) = (known.keys().find(is_foreign), shard) {
                let Shard { number, count } = shard;
                let reason = format!("case {case} does not belong to shard {number} of {count}");
                return Err(RowsError::Foreign(FileError::in_file(path, reason)));
            }
        }
        let mut journal = Self {
            curves: CurveJournal::open(study, &known, path, restart)?,
            path: path.to_owned(),
            partial,
            file,
            rows: known,
        };
        let end = journal.file.seek(SeekFrom::End(0));
        if end.map_err(|error| cannot_write(&journal.partial, error))? == 0 {
            journal.line(study.columns())?;
        }
        Ok(journal)
    }

    /// Rows computed so far.
    pub fn rows(&self) -> &Rows {
        &self.rows
    }

    /// Adds a row and the curves of its case.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub fn add(&mut self, study: &Study, row: Row, curves: Curves) -> Result<(), FileError> {
        let record = rows::record(study, &row);
        let record = record.map_err(|error| cannot_write(&self.partial, error))?;
        // The curves come first: a case whose row is present is not run again.
        if let Some(digest) = record.last() {
            self.curves.add(digest, curves)?;
        }
        self.line(record)?;
        self.rows.insert(row.case, row);
        Ok(())
    }

    /// Replaces the files of rows and curves by all rows and curves in the order of the cases, and returns them.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub fn finish(self, study: &Study) -> Result<Finished, FileError> {
        self.curves.write(study, &self.rows)?;
        rows::write(study, &self.rows, &self.path)?;
        // The rows must be on the disk before the partial file is removed.
        File::open(&self.path)
            .and_then(|file| file.sync_all())
            .map_err(|error| cannot_write(&self.path, error))?;
        let (curves, problems) = self.curves.end()?;
        fs::remove_file(&self.partial).map_err(|error| cannot_write(&self.partial, error))?;
        Ok(Finished {
            rows: self.rows,
            curves,
            problems,
        })
    }

    /// Removes the rows and curves of these cases, which must be in ascending order.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub fn remove(&mut self, study: &Study, cases: &[u64]) -> Result<(), FileError> {
        self.rows
            .retain(|case, _| cases.binary_search(case).is_err());
        self.file
            .set_len(0)
            .and_then(|()| self.file.rewind())
            .map_err(|error| cannot_write(&self.partial, error))?;
        self.line(study.columns())?;
        for row in self.rows.clone().values() {
            let record = rows::record(study, row);
            self.line(record.map_err(|error| cannot_write(&self.partial, error))?)?;
        }
        self.curves.remove(study, &self.rows, cases)
    }

    fn line(&mut self, cells: Vec<String>) -> Result<(), FileError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let written = writer.write_record(cells).map_err(io::Error::other);
        let bytes = written.and_then(|()| writer.into_inner().map_err(|error| error.into_error()));
        let bytes = bytes.and_then(|bytes| self.file.write_all(&bytes));
        bytes.map_err(|error| cannot_write(&self.partial, error))
    }
}

/// Opens the file at `path` with a lock, so that no other process can add to it.
fn locked(path: &Path) -> Result<File, FileError> {
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
