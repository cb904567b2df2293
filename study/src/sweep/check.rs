//! Rows that are run again and compared.

use fastrand::Rng;

use super::arithmetic::Arithmetic;
use super::row::Row;
use super::rows::Rows;
use super::run::{RunError, run};
use super::study::Study;

/// Why rows that were run again do not confirm a study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// The rows are of a processor of the other kind.
    #[error("the rows are of arithmetic {found}, and this processor has {here}: its bits differ")]
    Arithmetic {
        /// That of the rows.
        found: Arithmetic,
        /// That of this processor.
        here: Arithmetic,
    },
    /// A case cannot be run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A row has other cells than the run.
    #[error("case {case}: column {column}: `{found}`, run again: `{computed}`")]
    Differs {
        /// Number of the case.
        case: u64,
        /// The first column that differs.
        column: String,
        /// The cell of the row.
        found: String,
        /// The cell of the run.
        computed: String,
    },
    /// The user did not wait.
    #[error("interrupted: {done} of {all} cases were run again")]
    Interrupted {
        /// Cases that were run.
        done: usize,
        /// Cases that were chosen.
        all: usize,
    },
}

/// Chooses `count` cases of `rows` at random, all where there are fewer; the same for the same seed.
pub fn chosen(rows: &Rows, count: usize, seed: u64) -> Vec<u64> {
    let count = count.min(rows.len());
    let mut cases = Rng::with_seed(seed).choose_multiple(rows.keys().copied(), count);
    cases.sort_unstable();
    cases
}

/// Runs `cases` again and compares each with its row, bit for bit.
///
/// # Errors
/// A row that differs; rows of another arithmetic; a case that is refused; an interruption.
pub fn check(
    study: &Study,
    rows: &Rows,
    cases: &[u64],
    threads: usize,
    is_unwanted: &(dyn Fn() -> bool + Sync),
) -> Result<(), CheckError> {
    let here = Arithmetic::here();
    let mut found = rows.values().map(|row| row.arithmetic);
    if let Some(found) = found.find(|found| *found != here) {
        return Err(CheckError::Arithmetic { found, here });
    }
    let mut done = 0;
    run(study, cases, threads, is_unwanted, |row| {
        done += 1;
        compare(study, rows, &row)
    })?;
    match done == cases.len() {
        true => Ok(()),
        false => Err(CheckError::Interrupted {
            done,
            all: cases.len(),
        }),
    }
}

/// Cells tell numbers apart by every bit.
fn compare(study: &Study, rows: &Rows, computed: &Row) -> Result<(), CheckError> {
    let (Some(kept), Some(case)) = (rows.get(&computed.case), study.case(computed.case)) else {
        return Ok(());
    };
    let [kept, again] = [kept, computed].map(|row| study.record(&case, row));
    let columns = study.columns();
    let mut cells = columns.into_iter().zip(kept.into_iter().zip(again));
    match cells.find(|(_, (kept, again))| kept != again) {
        Some((column, (found, computed))) => Err(CheckError::Differs {
            case: case.number,
            column,
            found,
            computed,
        }),
        None => Ok(()),
    }
}
