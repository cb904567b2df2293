//! Indices that assess a pair of profiles or a ride, one file each.
//!
//! - [`RollingRadiusDifference`]: rolling radius difference function and equivalent conicity (EN 15302).
//! - [`sperling`]: ride index of an acceleration.
//! - [`mean_comfort`]: comfort index of EN 12299, with its [`Weighting`].
//! - [`welch`]: power spectral density.
//! - [`amplitudes`], [`signal_of`]: Fourier transforms of whole signals.
//! - [`Sperling`], [`WeightingFilter`], [`Welch`]: the same for a signal that arrives sample by sample or window by
//!   window.
//! - [`nadal_limit`], [`prudhomme_limit_n`], [`wheel_load_limit_n`], [`wheel_unloading`]: limits of wheel forces, which
//!   are filtered by [`LowPass`].
//! - Derailment coefficients are methods of [`WheelsetForces`](crate::contact::WheelsetForces).
//!
//! # To add an index
//!
//! Add a file to `rail/src/indices/`, named after the index. Compute the index from a [`Pair`](crate::contact::Pair),
//! from [`WheelsetForces`](crate::contact::WheelsetForces), or from a time series and its rate. Declare and re-export
//! it here, and test it in `rail/tests/` against a closed form or published values.

mod band;
mod comfort;
mod conicity;
mod fourier;
mod limits;
mod low_pass;
mod spectrum;
mod sperling;
mod weighting;
mod weighting_filter;
mod welch;

pub use comfort::{mean_comfort, mean_comfort_of_windows, weighted_rms};
pub use conicity::{CONTACT_DISTANCE_M, RollingRadiusDifference, RollingRadiusError};
pub use fourier::{amplitudes, signal_of};
pub use limits::{nadal_limit, prudhomme_limit_n, wheel_load_limit_n, wheel_unloading};
pub use low_pass::LowPass;
pub use spectrum::SpectrumError;
pub use sperling::{RideDirection, SPERLING_BAND_HZ, Sperling, sperling};
pub use weighting::{COMFORT_BAND_HZ, Weighting};
pub use weighting_filter::WeightingFilter;
pub use welch::{Welch, welch};
