//! Errors of layouts, generated irregularities and defects.

use std::fmt;

/// Location of an error in a track. Parts, defects and points are counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// A part of the layout.
    Part(usize),
    /// A defect.
    Defect(usize),
    /// The irregularity.
    Irregularity,
    /// A point of the gauge over the distance.
    Gauge(usize),
    /// A point of the friction over the distance.
    Friction(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Part(number) => write!(f, "part {number} of the layout"),
            Self::Defect(number) => write!(f, "defect {number}"),
            Self::Irregularity => f.write_str("irregularity"),
            Self::Gauge(number) => write!(f, "point {number} of the gauge"),
            Self::Friction(number) => write!(f, "point {number} of the friction"),
        }
    }
}

/// Errors of tracks.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// A quantity is out of bounds.
    #[error("{place}: {name} {value}, allowed: {} to {}", .allowed[0], .allowed[1])]
    OutOfBounds {
        /// Location.
        place: Place,
        /// Name of the quantity, including its unit.
        name: &'static str,
        /// Value.
        value: f64,
        /// Smallest and largest allowed value.
        allowed: [f64; 2],
    },
    /// The layout has no parts.
    #[error("the layout has no parts, allowed: one or more")]
    Empty,
    /// A transition has no straight or circular part on one side.
    #[error("{place}: a transition must lie between two straight or circular parts")]
    TransitionAtEnd {
        /// Location of the transition.
        place: Place,
    },
    /// A transition joins parts of the same curvature and cant.
    #[error(
        "{place}: a transition between parts of the same curvature and cant, allowed: parts that differ in one of them"
    )]
    NeedlessTransition {
        /// Location of the transition.
        place: Place,
    },
    /// The cant is discontinuous between two parts.
    #[error(
        "{place}: cant_m starts at {after_m}, but the previous part ends at {before_m}; put a transition between them"
    )]
    CantJump {
        /// Location of the second part.
        place: Place,
        /// Cant at the end of the first part, m.
        before_m: f64,
        /// Cant at the start of the second part, m.
        after_m: f64,
    },
    /// The class of track does not exist.
    #[error("FRA class {class}, allowed: 1 to 6")]
    Class {
        /// The requested class.
        class: u8,
    },
    /// The irregularity would have too many samples.
    #[error(
        "{place}: {samples:.0} samples, allowed: {} or fewer; use a shorter track or a wider spacing",
        super::MAX_SAMPLES
    )]
    TooManySamples {
        /// Location.
        place: Place,
        /// Number of samples.
        samples: f64,
    },
}

/// Checks that `value` is within `allowed`. NaN never is.
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
