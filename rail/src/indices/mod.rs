//! Indices by which a pair of profiles or a ride is judged, one file each.
//!
//! - [`RollingRadiusDifference`]: rolling radius difference function and equivalent conicity (EN 15302).
//! - Derailment coefficients belong to the forces: [`WheelsetForces`](crate::contact::WheelsetForces).
//!
//! # To add an index
//!
//! Add a file to `rail/src/indices/`, named after the index, that computes it from a
//! [`Pair`](crate::contact::Pair), from [`WheelsetForces`](crate::contact::WheelsetForces), or from a record over time and its step. Declare and re-export it
//! here, and test it in `rail/tests/contact/` against a closed form.

mod conicity;

pub use conicity::{CONTACT_DISTANCE_M, RollingRadiusDifference, RollingRadiusError};
