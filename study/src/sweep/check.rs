//! Check of rows by running their cases again.

use fastrand::Rng;

use super::plan::run;
use super::row::Row;
use super::rows::Rows;
use super::run::RunError;
use super::study::Study;

/// Error from running rows again.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// A case cannot be run.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A cell of a row differs from the result of the new run.
    #[error("case {case}: column {column}: `{found}`, but a new run gives `{computed}`")]
    Differs {
        /// Number of the case.
        case: u64,
        /// First column that differs.
        column: String,
        /// Cell of the row.
        found: String,
        /// Cell computed by the new run.
        computed: String,
    },
    /// Interrupted by the user.
    #[error("interrupted: {done} of {all} cases were run again")]
    Interrupted {
        /// Number of cases run so far.
        done: usize,
        /// Number of chosen cases.
        all: usize,
    },
}

/// Chooses `count` cases of `rows` at random, or all if there are fewer. The choice is the same for the same seed.
pub fn choose(rows: &Rows, count: usize, seed: u64) -> Vec<u64> {
    let count = count.min(rows.len());
    let mut cases = Rng::with_seed(seed).choose_multiple(rows.keys().copied(), count);
    cases.sort_unstable();
    cases
}

/// Runs `cases` again and compares each with its row, bit for bit.
///
/// # Errors
/// Returns an error for a row that differs, for an invalid case, or after an interruption.
pub fn check(
    study: &Study,
    rows: &Rows,
    cases: &[u64],
    threads: usize,
    is_cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<(), CheckError> {
    let mut done = 0;
    run(study, cases, threads, is_cancelled, |row| {
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

/// Compares a new row with the stored one. Cells contain enough digits to distinguish all numbers.
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
