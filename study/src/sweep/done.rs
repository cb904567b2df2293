//! Rows that a study has already, read without changing a file.

use std::path::Path;

use super::curves::with_ending;
use super::extension::{self, Kept, Moved};
use super::rows::{self, Rows, RowsError};
use super::study::Study;
use dashpot_files::input;

/// Reads the rows of the file at `path` and those of an interrupted run, as the next run would. Another process may be
/// adding rows.
///
/// # Errors
/// Returns an error if a file cannot be read, or if the study cannot continue from its rows.
pub fn rows_done(study: &Study, path: &Path) -> Result<Rows, RowsError> {
    let kept = Kept::read(path);
    let mut moved = Moved::default();
    let mut known = Rows::new();
    for file in [path, &with_ending(path, "partial")] {
        if !file.exists() {
            continue;
        }
        let bytes = input::read(file)?;
        let whole = rows::whole_lines(&bytes);
        if !whole.is_empty() {
            known.extend(extension::read_rows(
                study,
                &kept,
                (file, whole),
                &mut moved,
            )?);
        }
    }
    Ok(known)
}
