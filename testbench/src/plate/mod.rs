//! A shim stack as a thin (Kirchhoff) plate under non-uniform pressure: deflection, surface stress and the correction
//! factor Ce of the edge lift.
//!
//! The deflection for N equal bosses around the circumference is `w(r, t) = sum w_k(r) cos(k N t)`. The harmonics of a
//! circular plate are uncoupled (Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, Arts. 62 and 63), so
//! each `w_k` is solved for separately, in cubic Hermite elements over the radius.

mod area;
mod assumed;
mod bending;
mod correction;
mod error;
mod harmonic;
mod limits;
mod profile;
mod quadrature;
mod round_bosses;
mod stack;
mod stress;

pub use area::{Bosses, PressureArea};
pub use assumed::{Fit, WIDTHS, assumed_area, fits, is_ring, middle_ring};
pub use bending::{Bending, Curvature, Resolution};
pub use correction::{
    fitted_boss_radius_m, fitted_decay_width_m, fitted_full_radius_m, fitted_share,
};
pub use error::PlateError;
pub use profile::Profile;
pub use round_bosses::RoundBosses;
pub use stack::{Stack, Stacking};
pub use stress::{LargestStress, SurfaceStress};
