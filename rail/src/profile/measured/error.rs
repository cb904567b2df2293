//! Errors in the text of a measured profile.

use super::{MAX_FOLD_MM, MAX_GAP_MM, MIN_POINTS};
use crate::profile::CurveError;

/// Errors from reading a measured profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// A row has too few or too many columns.
    #[error("{found} columns, allowed: {allowed}")]
    Columns {
        /// Line of the text, counted from 1.
        line: u64,
        /// Number of columns found.
        found: usize,
        /// Number and names of the columns.
        allowed: String,
    },
    /// A cell is not a number within -1000 to 1000.
    #[error("{text:?} is not a number from -1000 to 1000")]
    Number {
        /// Line of the text, counted from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
        /// Content of the cell.
        text: String,
    },
    /// A key of the header has an invalid value.
    #[error("{key} = {text}, allowed: {allowed}")]
    Key {
        /// Line of the text, counted from 1.
        line: u64,
        /// Name of the key.
        key: &'static str,
        /// Its value.
        text: String,
        /// Allowed values.
        allowed: &'static str,
    },
    /// A line is unexpected.
    #[error("{text:?}, allowed: {allowed}")]
    Line {
        /// Line of the text, counted from 1.
        line: u64,
        /// Content of the line.
        text: String,
        /// Content that is allowed there.
        allowed: &'static str,
    },
    /// The text ends too early.
    #[error("cut short: {missing}")]
    CutShort {
        /// The missing part, and the allowed content.
        missing: String,
    },
    /// The sign of the lateral axis is ambiguous in this kind of file.
    #[error(
        "side not stated: in a GENSYS rail file y may point to either side; allowed: the option mirror, `none` if y \
         points to the field side, `y` if it points to the track centre"
    )]
    MirrorNotStated,
    /// There are fewer than [`MIN_POINTS`] points.
    #[error("too few points: {found}, allowed: {MIN_POINTS} or more")]
    TooFewPoints {
        /// Number of points found.
        found: usize,
    },
    /// The profile is too narrow or too wide for one in millimetres.
    #[error(
        "{width_mm} mm wide, allowed: {} to {} mm; {}",
        .allowed_mm[0], .allowed_mm[1], unit_hint(*.width_mm)
    )]
    Unit {
        /// Width of the profile if its lengths are in the unit of its format, mm.
        width_mm: f64,
        /// Minimum and maximum allowed width, mm.
        allowed_mm: [f64; 2],
    },
    /// The points do not follow one another along the curve.
    #[error(
        "points out of order: this one is {jump_mm:.1} mm from the previous one, although no part of the surface is \
         missing between them; allowed: points in their order along the curve, from either end"
    )]
    Unsorted {
        /// Line of the text, counted from 1.
        line: u64,
        /// Distance to the previous point, mm.
        jump_mm: f64,
    },
    /// The curve folds back, and then emerges again or runs back over the surface.
    #[error(
        "folded back by {fold_mm:.2} mm near y_mm {y_mm:.2}, allowed: {MAX_FOLD_MM} mm, or more if the curve then \
         stays inside the material until the profile ends"
    )]
    FoldedBack {
        /// Line of the text, counted from 1.
        line: u64,
        /// Lateral position at which the curve folds back, mm.
        y_mm: f64,
        /// Width of the fold, mm.
        fold_mm: f64,
    },
    /// Neighbouring points are more than [`MAX_GAP_MM`] apart.
    #[error("gap: {gap_mm:.2} mm to the neighbouring point, allowed: {MAX_GAP_MM} mm or less")]
    Gap {
        /// Line of the text, counted from 1.
        line: u64,
        /// Distance to the neighbour, mm.
        gap_mm: f64,
    },
    /// The wheel has no flange.
    #[error("no flange: the profile is {depth_mm:.1} mm deep, allowed: 15 mm or more")]
    NoFlange {
        /// Depth of the profile, mm.
        depth_mm: f64,
    },
    /// The flange of the wheel points up.
    #[error(
        "wrong side up: the flange must point to positive z_mm (down); the option mirror z turns it over"
    )]
    FlangeUp,
    /// The flange of the wheel is on the field side.
    #[error(
        "wrong side: the flange must lie at negative y_mm (towards the track centre); use the option mirror y, \
         or the format gensys for a GENSYS file"
    )]
    FlangeOutside,
    /// The origin of the wheel is not its tread datum.
    #[error(
        "y_mm from {from_mm:.1} to {to_mm:.1} with the flange tip at {tip_mm:.1}; y_mm must be 0 at the tread \
         datum and negative at the flange tip (in a SIMPACK file, shift.y moves the profile)"
    )]
    DatumOutside {
        /// Minimum lateral position, mm.
        from_mm: f64,
        /// Maximum lateral position, mm.
        to_mm: f64,
        /// Lateral position of the flange tip, mm.
        tip_mm: f64,
    },
    /// The head of the rail does not point up.
    #[error(
        "wrong side up: the top of the head must have the smallest z_mm (down is positive), and both sides must be \
         0.5 mm deeper or more; the option mirror z turns it over"
    )]
    HeadDown,
    /// No smooth curve fits the points.
    #[error(transparent)]
    Curve(#[from] CurveError),
}

impl ProfileError {
    /// Line of the error, counted from 1; `None` if the error does not concern one line.
    pub fn line(&self) -> Option<u64> {
        match *self {
            Self::Columns { line, .. }
            | Self::Number { line, .. }
            | Self::Key { line, .. }
            | Self::Line { line, .. }
            | Self::Unsorted { line, .. }
            | Self::FoldedBack { line, .. }
            | Self::Gap { line, .. } => Some(line),
            _ => None,
        }
    }

    /// Column of the error; `None` if the error does not concern one cell.
    pub fn column(&self) -> Option<&'static str> {
        match *self {
            Self::Number { column, .. } => Some(column),
            _ => None,
        }
    }
}

/// The probable mistake behind the width of a profile.
fn unit_hint(width_mm: f64) -> &'static str {
    if width_mm < 1.0 {
        "the lengths seem to be in metres: multiply them by 1000, or, in a SIMPACK file, set units.len.f to 1"
    } else if width_mm < 100.0 {
        "the lengths seem to be in inches: multiply them by 25.4"
    } else {
        "the lengths seem to be smaller than millimetres: convert them to mm, or, in a SIMPACK file, set units.len.f \
         to the number of its units per metre"
    }
}
