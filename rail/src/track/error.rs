//! What can be wrong with a layout, a generated irregularity or a defect.

use std::fmt;

/// What of a track an error is of; parts and defects are counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A part of the layout.
    Part(usize),
    /// A defect.
    Defect(usize),
    /// The irregularity.
    Irregularity,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Part(number) => write!(f, "part {number} of the layout"),
            Self::Defect(number) => write!(f, "defect {number}"),
            Self::Irregularity => f.write_str("irregularity"),
        }
    }
}

/// Why a track is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// A quantity is out of bounds.
    #[error("{place}: {name} {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Where it stands.
        place: Place,
        /// Name of the quantity, its unit included.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Smallest and greatest allowed value.
        allowed: [f64; 2],
    },
    /// A layout has no parts.
    #[error("layout without parts, allowed: one or more")]
    Empty,
    /// A transition lacks a straight or a circular part on one side.
    #[error(
        "{place}: a transition without neighbours, allowed: between two straight or circular parts"
    )]
    TransitionAtEnd {
        /// Number of the transition.
        place: Place,
    },
    /// A transition joins parts of the same curvature and cant.
    #[error(
        "{place}: a transition between parts of the same curvature and cant, allowed: where one of them changes"
    )]
    NeedlessTransition {
        /// Number of the transition.
        place: Place,
    },
    /// The cant jumps between two parts.
    #[error(
        "{place}: cant_m begins with {after_m} where the part before ends with {before_m}, allowed: a transition between them"
    )]
    CantJump {
        /// Number of the second part.
        place: Place,
        /// Cant before, m.
        before_m: f64,
        /// Cant behind, m.
        after_m: f64,
    },
    /// There is no such class of track.
    #[error("FRA class {class}, allowed: 1 to 6")]
    Class {
        /// The class asked for.
        class: u8,
    },
    /// There would be too many samples.
    #[error(
        "{place}: {samples:.0} samples, allowed: {} or fewer: a shorter track or a wider spacing",
        super::MAX_SAMPLES
    )]
    TooManySamples {
        /// Where they are.
        place: Place,
        /// Number of samples.
        samples: f64,
    },
}

/// Checks that `value` lies in `allowed`; NaN does not.
pub(super) fn within(
    place: Place,
    name: &'static str,
    value: f64,
    allowed: [f64; 2],
) -> Result<(), TrackError> {
    if (allowed[0]..=allowed[1]).contains(&value) {
        Ok(())
    } else {
        Err(TrackError::OutOfBounds {
            place,
            name,
            value,
            allowed,
        })
    }
}
