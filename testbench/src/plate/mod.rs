//! A shim stack as a thin plate (Kirchhoff) under pressure that need not be uniform: deflection, surface stress, and the
//! correction factor Ce of the edge's lift.
//!
//! The deflection is `w(r, t) = sum w_k(r) cos(k N t)` for N equal bosses over the circumference, each `w_k` by cubic Hermite
//! elements in the radius, since the harmonics of a round plate do not act on each other (Timoshenko and Woinowsky-Krieger,
//! Theory of Plates and Shells, Arts. 62 and 63).

mod area;
mod assumed;
mod bending;
mod correction;
mod error;
mod harmonic;
mod profile;
mod quadrature;
mod refusal;
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
