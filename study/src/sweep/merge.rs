//! Merges the rows of the shards of a study.

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

use super::rows::{self, NumberedRow, Rows, RowsError};
use super::study::Study;

/// Error from merging shards.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// A file cannot be read or belongs to another study.
    #[error(transparent)]
    Rows(#[from] RowsError),
    /// Cases are missing or occur more than once.
    #[error("{0}")]
    Gaps(Gaps),
}

/// Missing and duplicate cases.
#[derive(Debug, Clone, PartialEq)]
pub struct Gaps {
    /// Number of cases in the study.
    pub cases: u64,
    /// Numbers of the missing cases.
    pub missing: Vec<u64>,
    /// Cases that occur more than once.
    pub duplicates: Vec<Duplicate>,
}

/// Case that occurs more than once.
#[derive(Debug, Clone, PartialEq)]
pub struct Duplicate {
    /// Number of the case.
    pub case: u64,
    /// File of each occurrence.
    pub files: Vec<PathBuf>,
}

/// Reads the rows of all files, which together must contain each case of the study once.
///
/// # Errors
/// Returns an error for rows of another study, or for missing or duplicate cases.
pub fn merge(study: &Study, files: &[PathBuf]) -> Result<Rows, MergeError> {
    let mut rows = Rows::new();
    let mut files_of_case: BTreeMap<u64, Vec<PathBuf>> = BTreeMap::new();
    for file in files {
        let read = rows::read(study, file)?;
        for NumberedRow { row, .. } in read {
            files_of_case
                .entry(row.case)
                .or_default()
                .push(file.clone());
            rows.insert(row.case, row);
        }
    }
    let missing: Vec<u64> = study
        .part(None)
        .filter(|number| !rows.contains_key(number))
        .collect();
    files_of_case.retain(|_, files| files.len() > 1);
    if missing.is_empty() && files_of_case.is_empty() {
        return Ok(rows);
    }
    let duplicates = files_of_case.into_iter();
    Err(MergeError::Gaps(Gaps {
        cases: study.cases(),
        missing,
        duplicates: duplicates
            .map(|(case, files)| Duplicate { case, files })
            .collect(),
    }))
}

impl fmt::Display for Gaps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            cases,
            missing,
            duplicates,
        } = self;
        if !missing.is_empty() {
            let count = missing.len();
            write!(
                f,
                "{count} of {cases} cases are missing: {}",
                Ranges(missing)
            )?;
        }
        // Cases that occur in the same files are reported together.
        let mut cases_of_files: BTreeMap<&[PathBuf], Vec<u64>> = BTreeMap::new();
        for Duplicate { case, files } in duplicates {
            cases_of_files.entry(files).or_default().push(*case);
        }
        for (index, (files, numbers)) in cases_of_files.into_iter().enumerate() {
            if index > 0 || !missing.is_empty() {
                f.write_str("; ")?;
            }
            let files: Vec<String> = files
                .iter()
                .map(|file| file.display().to_string())
                .collect();
            let files = files.join(" and ");
            write!(f, "duplicates in {files}: {}", Ranges(&numbers))?;
        }
        Ok(())
    }
}

/// Numbers in ascending order; consecutive numbers are shown as `first-last`.
struct Ranges<'a>(&'a [u64]);

impl fmt::Display for Ranges<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let runs = self.0.chunk_by(|a, b| a + 1 == *b);
        for (index, run) in runs.enumerate() {
            if index > 0 {
                f.write_str(", ")?;
            }
            match run {
                [first, .., last] => write!(f, "{first}-{last}")?,
                [only] => write!(f, "{only}")?,
                [] => {}
            }
        }
        Ok(())
    }
}
