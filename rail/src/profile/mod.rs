//! Profiles of wheels and rails: plane curves with tangent and curvature, sampled along their arc.
//!
//! - [`s1002`] and [`uic60`]: the standard wheel and rail, from their definitions.
//! - [`measured`]: a profile from the file of a profile gauge or of a simulation program, with every error located.
//! - [`Profile::through`]: a profile from your own points.
//!
//! Axes of a profile: `y` to the field side (away from the track centre), `z` down. A wheel's origin is
//! its tread datum, a rail's the top of its head.

mod curve;
pub mod measured;
pub mod s1002;
pub mod uic60;

pub use curve::{CurveError, MAX_LENGTH_M, MIN_POINTS, Profile, ProfilePoint, SAMPLE_SPACING_M};

/// The body that a profile belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// A wheel: the flange is on the negative `y` side and points down.
    Wheel,
    /// A rail: the head is up and the gauge face is on the negative `y` side.
    Rail,
}
