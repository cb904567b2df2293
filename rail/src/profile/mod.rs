//! Profiles of wheels and rails: plane curves with tangent and curvature, sampled along the arc length.
//!
//! - [`s1002`] and [`uic60`]: the standard wheel and rail, from their definitions.
//! - [`measured`]: reads the files of profile gauges and simulation programs; errors name the line.
//! - [`Profile::through`]: builds a profile from your own points.
//!
//! Axes of a profile: `y` to the field side (away from the track centre), `z` down. The origin of a wheel is its tread
//! datum, that of a rail the top of its head.

mod curve;
pub mod measured;
pub mod s1002;
pub mod uic60;

pub use curve::{CurveError, MAX_LENGTH_M, MIN_POINTS, Profile, ProfilePoint, SAMPLE_SPACING_M};

/// The body that a profile belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// A wheel, with its flange at negative `y`, pointing down.
    Wheel,
    /// A rail, with its head up and its gauge face at negative `y`.
    Rail,
}
