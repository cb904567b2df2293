//! Rows of a running study, written one by one so that an interruption loses none.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::curves::{self, CurveJournal, CurveKey, CurveKind, Curves, KnownRows, with_ending};
use super::extension::{self, Kept, Moved, Outline};
use super::lock::locked;
use super::observed::IndexValues;
use super::row::Row;
use super::rows::{self, Rows, RowsError};
use super::study::{Shard, Study};
use dashpot_files::output::cannot_write;
use dashpot_files::{FileError, input};

/// Rows computed so far with the curves and indices of their cases, and the files to which new ones are added: the
/// files of rows and curves with `.partial` appended to their names, and that of the indices.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    partial: PathBuf,
    file: File,
    rows: Rows,
    curves: CurveJournal,
    kept: Kept,
    outline: Outline,
    /// Rows of earlier studies, which this one extends.
    moved: Moved,
}

/// How a journal begins.
#[derive(Debug, Clone, Copy, Default)]
pub struct Start<'a> {
    /// Part of the study whose rows it has; all if `None`.
    pub shard: Option<Shard>,
    /// Starts without rows and renames existing files to `.old`.
    pub restart: bool,
    /// Rows of this study, or of one that it extends, in another file.
    pub reuse: Option<&'a Path>,
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
    /// Opens the rows of the file at `path` and of an interrupted run, with their curves. If the study extends that of
    /// existing rows, these rows become its own.
    ///
    /// # Errors
    /// Returns an error if a file cannot be read or written, if it contains rows of another study or shard, or if
    /// another process is adding rows.
    pub fn open(study: &Study, path: &Path, start: Start<'_>) -> Result<Self, RowsError> {
        let partial = with_ending(path, "partial");
        let mut file = locked(&partial)?;
        let outline = Outline::of(study)?;
        let mut known = Rows::new();
        let mut moved = Moved::default();
        let mut has_header = false;
        if start.restart {
            file.set_len(0)
                .map_err(|error| cannot_write(&partial, error))?;
            for path in [path, &extension::path_of(path)] {
                if path.exists() {
                    let old = with_ending(path, "old");
                    fs::rename(path, &old).map_err(|error| cannot_write(&old, error))?;
                }
            }
        }
        let mut kept = Kept::read(path);
        if !start.restart {
            if path.exists() {
                let bytes = input::read(path)?;
                known = extension::read_rows(study, &kept, (path, &bytes), &mut moved)?;
            }
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes)
                .map_err(|error| FileError::read(&partial, error))?;
            let bytes = rows::whole_lines(&bytes);
            if !bytes.is_empty() {
                let read = extension::read_rows(study, &kept, (&partial, bytes), &mut moved)?;
                known.extend(read);
                has_header = rows::ends_in_section_of(study, bytes);
            }
            check_shard(path, start.shard, &known, &moved)?;
            file.set_len(bytes.len() as u64)
                .map_err(|error| cannot_write(&partial, error))?;
        }
        let of_rows = KnownRows::new(study, &known, &moved.cases);
        let mut curves = CurveJournal::open(of_rows, path, start.restart)?;
        if !moved.cases.is_empty() {
            curves.retain(&study.needed_curves());
        }
        kept.add_outline(outline.clone())?;
        let mut journal = Self {
            curves,
            path: path.to_owned(),
            partial,
            file,
            rows: known,
            kept,
            outline,
            moved,
        };
        let end = journal.file.seek(SeekFrom::End(0));
        end.map_err(|error| cannot_write(&journal.partial, error))?;
        if !has_header {
            journal.line(study.columns())?;
        }
        if let Some(other) = start.reuse {
            journal.reuse(study, other, start.shard)?;
        }
        Ok(journal)
    }

    /// Adds the rows of another file, those that are missing and belong to the shard.
    fn reuse(&mut self, study: &Study, path: &Path, shard: Option<Shard>) -> Result<(), RowsError> {
        let (bytes, kept) = (input::read(path)?, Kept::read(path));
        let mut moved = Moved::default();
        let rows = extension::read_rows(study, &kept, (path, &bytes), &mut moved)?;
        let known = KnownRows::new(study, &rows, &moved.cases);
        let mut curves = known.read(&curves::path_of(path)).curves;
        let needed = study.needed_curves();
        curves.retain(|key, _| curves::is_needed(&needed, key));
        for row in rows.into_values() {
            let is_own = shard.is_none_or(|shard| shard.contains(row.case));
            if !is_own || self.rows.contains_key(&row.case) {
                continue;
            }
            // The rows and the keys of the curves are in the order of the cases.
            let next = CurveKey {
                case: row.case + 1,
                signal: String::new(),
                kind: CurveKind::History,
            };
            let later = curves.split_off(&next);
            let mut own = std::mem::replace(&mut curves, later);
            own.retain(|key, _| key.case == row.case);
            let digest = study.digest_of(&row).unwrap_or_default();
            let indices = moved.indices.remove(&row.case);
            let indices = indices.or_else(|| kept.indices(row.case, &digest).cloned());
            self.moved.indices.insert(row.case, IndexValues::new());
            self.add(study, row, own, indices.unwrap_or_default())?;
        }
        self.moved.studies.append(&mut moved.studies);
        self.moved.lacking.append(&mut moved.lacking);
        Ok(())
    }

    /// Rows computed so far.
    pub fn rows(&self) -> &Rows {
        &self.rows
    }

    /// Rows that came from earlier studies or another file.
    pub fn moved(&self) -> &Moved {
        &self.moved
    }

    /// Adds a row with the curves and indices of its case.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub fn add(
        &mut self,
        study: &Study,
        row: Row,
        curves: Curves,
        indices: IndexValues,
    ) -> Result<(), FileError> {
        let record = rows::record(study, &row);
        let record = record.map_err(|error| cannot_write(&self.partial, error))?;
        // Curves and indices come first: a case whose row is present is not run again.
        if let Some(digest) = record.last() {
            self.curves.add(digest, curves)?;
            self.kept.add(row.case, digest, indices)?;
        }
        self.line(record)?;
        self.rows.insert(row.case, row);
        Ok(())
    }

    /// Replaces the files of rows, curves and indices by those of all cases in their order, and returns them.
    ///
    /// # Errors
    /// Returns an error if a file cannot be written.
    pub fn finish(self, study: &Study) -> Result<Finished, FileError> {
        let Self {
            rows, kept, moved, ..
        } = self;
        self.curves.write(study, &rows)?;
        rows::write(study, &rows, &self.path)?;
        // The rows must be on the disk before the partial file is removed.
        File::open(&self.path)
            .and_then(|file| file.sync_all())
            .map_err(|error| cannot_write(&self.path, error))?;
        let (curves, problems) = self.curves.end()?;
        let indices: Vec<(u64, String, IndexValues)> = rows
            .values()
            .filter_map(|row| {
                let digest = study.digest_of(row)?;
                let own = kept.indices(row.case, &digest);
                let indices = own.or_else(|| moved.indices.get(&row.case))?.clone();
                Some((row.case, digest, indices))
            })
            .collect();
        kept.finish(self.outline, indices.into_iter())?;
        fs::remove_file(&self.partial).map_err(|error| cannot_write(&self.partial, error))?;
        Ok(Finished {
            rows,
            curves,
            problems,
        })
    }

    /// Removes the rows, curves and indices of these cases, which must be in ascending order.
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
        self.kept.remove(cases)?;
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

/// Refuses rows of another shard. The cases of an extended study have other numbers, so they are in other shards.
fn check_shard(
    path: &Path,
    shard: Option<Shard>,
    known: &Rows,
    moved: &Moved,
) -> Result<(), RowsError> {
    let Some(shard) = shard else {
        return Ok(());
    };
    let refused = |reason: String| Err(RowsError::Foreign(FileError::in_file(path, reason)));
    if let Some(earlier) = moved.studies.first() {
        return refused(format!(
            "the rows of this shard are of study {earlier}, which the study now extends; the cases have new numbers, \
             so merge the rows of the earlier study and pass the merged file to each shard with --reuse"
        ));
    }
    match known.keys().find(|case| !shard.contains(**case)) {
        Some(case) => {
            let Shard { number, count } = shard;
            refused(format!(
                "case {case} does not belong to shard {number} of {count}"
            ))
        }
        None => Ok(()),
    }
}
