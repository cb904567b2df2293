//! What can be wrong with the text of a recording.

/// Most ticks that a recording may span: 24 hours at 10 kHz, so that one mistyped time does not fill a disk.
pub(crate) const MOST_TICKS: f64 = 864e6;

/// What a recording must be beside its columns.
const ACCEPTED: &str = "cells separated by commas, numbers with a decimal point";

/// What is wrong with the text of a recording; the file, and the line and column where there is one, are
/// in [`FileError`](crate::files::FileError).
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The file holds nothing.
    #[error("empty; a header `time_s,{value}` and at least one row are needed")]
    Empty {
        /// Name of the column beside the time.
        value: &'static str,
    },
    /// The header has a column more than once.
    #[error("column {column} is in the header {times} times")]
    RepeatedColumn {
        /// Name of the column.
        column: &'static str,
        /// How many there are.
        times: usize,
    },
    /// The header lacks a column: it is missing, or the file is of another kind.
    #[error(
        "{found}; accepted is UTF-8 text with a header that names time_s and {value}, {ACCEPTED}"
    )]
    Header {
        /// What was found instead.
        found: String,
        /// Name of the column beside the time.
        value: &'static str,
    },
    /// The header is all there is.
    #[error("no row after the header")]
    NoRow,
    /// The file is not CSV.
    #[error("cannot read: {0}")]
    Csv(#[from] csv::Error),
    /// A row has more or fewer cells than the header.
    #[error("line {line}: {cells} cells where the header has {expected}{}", decimal_comma(*cells, *expected))]
    Cells {
        /// Line of the file, from 1.
        line: u64,
        /// Cells of the row.
        cells: u64,
        /// Cells of the header.
        expected: u64,
    },
    /// A cell holds no finite number.
    #[error("`{cell}` is not a finite number{}", if *.decimal_comma { "; it has a decimal comma, accepted is a decimal point" } else { "" })]
    Number {
        /// The cell's text, at most 40 bytes of it.
        cell: String,
        /// Whether it is a number with a decimal comma.
        decimal_comma: bool,
    },
    /// Time stands still or goes back.
    #[error("time {time_s} s does not grow; the row before has {before_s} s")]
    Time {
        /// Time of the row (s).
        time_s: f64,
        /// Time of the row before (s).
        before_s: f64,
    },
    /// The recording does not last as long as it is needed.
    #[error("it lasts from {} s to {} s, the run takes a force from {} s to {} s", lasts_s[0], lasts_s[1], needed_s[0], needed_s[1])]
    Short {
        /// Times of its first and last row (s).
        lasts_s: [f64; 2],
        /// Times between which there must be a force (s).
        needed_s: [f64; 2],
    },
    /// The recording is too long for the step.
    #[error(
        "{time_s} s is more than {MOST_TICKS} ticks after the first sample; split the recording or take a larger step"
    )]
    TooLong {
        /// Time of the row (s).
        time_s: f64,
    },
}

/// A hint for rows with twice the cells.
fn decimal_comma(cells: u64, expected: u64) -> &'static str {
    if cells == 2 * expected {
        "; numbers with a decimal comma have twice the cells, accepted is a decimal point"
    } else {
        ""
    }
}
