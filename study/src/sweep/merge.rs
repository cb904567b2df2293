//! The rows of a study's shards together.

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

use super::rows::{self, Rows, RowsError};
use super::study::Study;

/// Why shards are not the whole study.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// A file cannot be read or is not of this study.
    #[error(transparent)]
    Rows(#[from] RowsError),
    /// Cases are missing or there twice.
    #[error("{0}")]
    Gaps(Gaps),
}

/// Cases that are missing, and those that are there more than once.
#[derive(Debug, Clone, PartialEq)]
pub struct Gaps {
    /// Cases of the study.
    pub cases: u64,
    /// Numbers of missing ones.
    pub missing: Vec<u64>,
    /// Numbers of those that there are more of, with their files.
    pub double: Vec<(u64, Vec<PathBuf>)>,
}

/// The rows of all files, each case of the study once.
///
/// # Errors
/// Rows that are not of the study; cases that are missing or double.
pub fn merge(study: &Study, files: &[PathBuf]) -> Result<Rows, MergeError> {
    let mut rows = Rows::new();
    let mut places: BTreeMap<u64, Vec<PathBuf>> = BTreeMap::new();
    for file in files {
        let read = rows::read(study, file)?;
        let expected = rows.values().next().or(read.first().map(|(_, row)| row));
        if let Some(expected) = expected.map(|row| row.arithmetic) {
            rows::check_arithmetic(file, read.iter().map(|(_, row)| row), expected)?;
        }
        for (_, row) in read {
            places.entry(row.case).or_default().push(file.clone());
            rows.insert(row.case, row);
        }
    }
    let missing: Vec<u64> = study
        .part(None)
        .filter(|number| !rows.contains_key(number))
        .collect();
    places.retain(|_, places| places.len() > 1);
    if missing.is_empty() && places.is_empty() {
        return Ok(rows);
    }
    Err(MergeError::Gaps(Gaps {
        cases: study.cases(),
        missing,
        double: places.into_iter().collect(),
    }))
}

impl fmt::Display for Gaps {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            cases,
            missing,
            double,
        } = self;
        if !missing.is_empty() {
            let count = missing.len();
            write!(
                f,
                "{count} of {cases} cases are missing: {}",
                Ranges(missing)
            )?;
        }
        // Cases that the same files have are told together.
        let mut of_files: BTreeMap<&[PathBuf], Vec<u64>> = BTreeMap::new();
        for (case, files) in double {
            of_files.entry(files).or_default().push(*case);
        }
        for (number, (files, numbers)) in of_files.into_iter().enumerate() {
            if number > 0 || !missing.is_empty() {
                f.write_str("; ")?;
            }
            let files: Vec<String> = files
                .iter()
                .map(|file| file.display().to_string())
                .collect();
            let files = files.join(" and ");
            write!(f, "double, in {files}: {}", Ranges(&numbers))?;
        }
        Ok(())
    }
}

/// Numbers in rising order, those that follow one another as `first-last`.
struct Ranges<'a>(&'a [u64]);

impl fmt::Display for Ranges<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let runs = self.0.chunk_by(|a, b| a + 1 == *b);
        for (number, run) in runs.enumerate() {
            if number > 0 {
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
