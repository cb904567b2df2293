//! Errors of measured track files.

use super::{MAX_INTERVAL_M, MIN_INTERVAL_M, MIN_ROWS};
use crate::track::TrackError;

/// Errors of reading a measured track.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredTrackError {
    /// The header has an unknown column name.
    #[error("unknown column {name:?}, allowed: {allowed}, separated by commas")]
    Header {
        /// Line, counted from 1.
        line: u64,
        /// The unknown name.
        name: String,
        /// Allowed names.
        allowed: &'static str,
    },
    /// The header has a column twice, possibly once in m and once in mm.
    #[error("column {name:?}: {column} appears twice, allowed: once")]
    Twice {
        /// Line, counted from 1.
        line: u64,
        /// The second name.
        name: String,
        /// Quantity of the column.
        column: &'static str,
    },
    /// The header has no distance column, or no other column.
    #[error("columns {found}, allowed: distance_m and one or more of {allowed}")]
    Missing {
        /// Line, counted from 1.
        line: u64,
        /// Names in the header.
        found: String,
        /// Allowed names.
        allowed: &'static str,
    },
    /// A row has too few or too many cells.
    #[error("{found} cells, allowed: {allowed}, as in the header")]
    Cells {
        /// Line, counted from 1.
        line: u64,
        /// Number of cells in the row.
        found: usize,
        /// Number of columns in the header.
        allowed: usize,
    },
    /// A cell is not a number or is out of bounds.
    #[error("{text:?}, allowed: a number from {} to {}", -.limit, .limit)]
    Number {
        /// Line, counted from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// Content of the cell.
        text: String,
        /// Maximum magnitude, in the unit of the column.
        limit: f64,
    },
    /// The interval from the previous row is too short or too long.
    #[error(
        "{interval_m} m after the previous row, allowed: rising distances, {MIN_INTERVAL_M} to {MAX_INTERVAL_M} m apart"
    )]
    Interval {
        /// Line, counted from 1.
        line: u64,
        /// Distance from the previous row, m.
        interval_m: f64,
    },
    /// There are fewer than [`MIN_ROWS`] rows.
    #[error("too few rows: {found}, allowed: {MIN_ROWS} or more")]
    TooFewRows {
        /// Number of rows.
        found: usize,
    },
    /// Spacing, ramp or number of samples is out of bounds.
    #[error(transparent)]
    Options(#[from] TrackError),
}

impl MeasuredTrackError {
    /// Returns the line of the error, counted from 1; `None` if it does not concern a single line.
    pub fn line(&self) -> Option<u64> {
        match *self {
            Self::Header { line, .. }
            | Self::Twice { line, .. }
            | Self::Missing { line, .. }
            | Self::Cells { line, .. }
            | Self::Number { line, .. }
            | Self::Interval { line, .. } => Some(line),
            Self::TooFewRows { .. } | Self::Options(_) => None,
        }
    }

    /// Returns the column of the error; `None` if it does not concern a single cell.
    pub fn column(&self) -> Option<&str> {
        match self {
            Self::Number { column, .. } => Some(column),
            Self::Interval { .. } => Some("distance_m"),
            _ => None,
        }
    }
}
