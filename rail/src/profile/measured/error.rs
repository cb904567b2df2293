//! What can be wrong with the text of a measured profile.

use super::{COLUMNS, MAX_GAP_MM, MIN_POINTS};
use crate::profile::CurveError;

/// Why a text is not a profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// A row does not have two columns.
    #[error("line {line}: {found} columns, allowed: 2 (y_mm, z_mm)")]
    Columns {
        /// Line of the text, counted from 1.
        line: u64,
        /// Number of columns found.
        found: usize,
    },
    /// A cell is not a number from -1000 to 1000.
    #[error("{text:?} is not a number from -1000 to 1000")]
    Number {
        /// Line of the text, counted from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
        /// Content of the cell.
        text: String,
    },
    /// There are fewer than [`MIN_POINTS`] points.
    #[error("too few points: {found}, allowed: {MIN_POINTS} or more")]
    TooFewPoints {
        /// Number of points found.
        found: usize,
    },
    /// The lateral position does not keep its direction.
    #[error("folded back: {y_mm} follows {before_mm}, allowed: one direction throughout")]
    FoldedBack {
        /// Line of the text, counted from 1.
        line: u64,
        /// Lateral position on that line, mm.
        y_mm: f64,
        /// Lateral position of the point before, mm.
        before_mm: f64,
    },
    /// Neighbouring points are further apart than [`MAX_GAP_MM`].
    #[error("gap: {gap_mm:.2} mm to its neighbour, allowed: {MAX_GAP_MM} mm")]
    Gap {
        /// Line of the text, counted from 1.
        line: u64,
        /// Distance to the point before, mm.
        gap_mm: f64,
    },
    /// The wheel has no flange.
    #[error("no flange: the profile is {depth_mm:.1} mm deep, allowed: 15 mm or more")]
    NoFlange {
        /// Depth of the profile, mm.
        depth_mm: f64,
    },
    /// The flange of the wheel points up.
    #[error("wrong side up: the flange must point to positive z_mm (down)")]
    FlangeUp,
    /// The flange of the wheel lies on the field side.
    #[error("wrong side: the flange must lie at negative y_mm (towards the track centre)")]
    FlangeOutside,
    /// The head of the rail does not point up.
    #[error(
        "wrong side up: the head must be the least z_mm (up), both sides 0.5 mm deeper or more"
    )]
    HeadDown,
    /// The points do not make a smooth curve.
    #[error(transparent)]
    Curve(#[from] CurveError),
}

impl ProfileError {
    /// Line (counted from 1) and column of the cell in error; `None` where the error is not of one cell.
    pub fn cell(&self) -> Option<(u64, &'static str)> {
        match *self {
            Self::Number { line, column, .. } => Some((line, column)),
            Self::FoldedBack { line, .. } | Self::Gap { line, .. } => Some((line, COLUMNS[0])),
            _ => None,
        }
    }
}
