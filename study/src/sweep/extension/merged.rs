//! Outline and indices of a merged study.

use std::path::{Path, PathBuf};

use super::kept::Kept;
use super::outline::Outline;
use crate::sweep::rows::Rows;
use crate::sweep::study::Study;
use dashpot_files::FileError;

/// Writes the outline and the indices of the merged `rows` beside their file at `path`. The indices are read beside
/// the `files` of the shards.
///
/// # Errors
/// Returns an error if the file cannot be written, or if a file of the study has changed and is invalid now.
pub fn write_merged(
    study: &Study,
    rows: &Rows,
    files: &[PathBuf],
    path: &Path,
) -> Result<(), FileError> {
    let outline = Outline::of(study)?;
    let shards: Vec<Kept> = files.iter().map(|file| Kept::read(file)).collect();
    let cases = rows.values().filter_map(|row| {
        let digest = study.digest_of(row)?;
        let mut found = shards
            .iter()
            .filter_map(|kept| kept.indices(row.case, &digest));
        let indices = found.next()?.clone();
        Some((row.case, digest, indices))
    });
    Kept::read(path).finish(outline, cases)
}
