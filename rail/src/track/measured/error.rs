//! What can be wrong with the text of a measured track.

use super::{MAX_INTERVAL_M, MIN_INTERVAL_M, MIN_ROWS};
use crate::track::TrackError;

/// Why a text is not a measured track.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeasuredTrackError {
    /// The header has a name that is no column's.
    #[error("column {name:?}, allowed: {allowed}, with commas between them")]
    Header {
        /// Line of the text, counted from 1.
        line: u64,
        /// The name.
        name: String,
        /// Names that are allowed.
        allowed: &'static str,
    },
    /// The header names a column twice, perhaps in m and in mm.
    #[error("column {name:?} beside another of {column}, allowed: one")]
    Twice {
        /// Line of the text, counted from 1.
        line: u64,
        /// The second name.
        name: String,
        /// What it holds.
        column: &'static str,
    },
    /// The header has no column of distances, or only that one.
    #[error("columns {found}, allowed: distance_m and one or more of {allowed}")]
    Missing {
        /// Line of the text, counted from 1.
        line: u64,
        /// Names found.
        found: String,
        /// Names that are allowed.
        allowed: &'static str,
    },
    /// A row has too few or too many cells.
    #[error("{found} cells, allowed: {allowed}, as the header")]
    Cells {
        /// Line of the text, counted from 1.
        line: u64,
        /// Number of cells found.
        found: usize,
        /// Number of columns of the header.
        allowed: usize,
    },
    /// A cell is not a number, or out of bounds.
    #[error("{text:?}, allowed: a number from {} to {}", -.limit, .limit)]
    Number {
        /// Line of the text, counted from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// Content of the cell.
        text: String,
        /// Greatest magnitude, in the unit of the column.
        limit: f64,
    },
    /// A distance is not far enough behind the one before, or too far.
    #[error(
        "{interval_m} m behind the row before, allowed: {MIN_INTERVAL_M} to {MAX_INTERVAL_M} m, rising"
    )]
    Interval {
        /// Line of the text, counted from 1.
        line: u64,
        /// Distance from the row before, m.
        interval_m: f64,
    },
    /// There are fewer than [`MIN_ROWS`] rows.
    #[error("too few rows: {found}, allowed: {MIN_ROWS} or more")]
    TooFewRows {
        /// Number of rows found.
        found: usize,
    },
    /// Spacing, ramp or number of samples are out of bounds.
    #[error(transparent)]
    Options(#[from] TrackError),
}

impl MeasuredTrackError {
    /// Line in error, counted from 1; `None` where the error is not of one line.
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

    /// Column in error; `None` where the error is not of one cell.
    pub fn column(&self) -> Option<&str> {
        match self {
            Self::Number { column, .. } => Some(column),
            Self::Interval { .. } => Some("distance_m"),
            _ => None,
        }
    }
}
