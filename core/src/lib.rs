//! Fixed-step, allocation-free hydraulic damper for hardware-in-the-loop firmware.
//!
//! Parameters in SI units are built, once and with every error there is, into a [`Damper`]: constants
//! for one step size. A [`DamperState`] holds what changes. [`Damper::step`] turns the displacement of
//! a tick into the force of that tick in a fixed number of operations; it cannot fail, allocates
//! nothing and uses + - * / only, so every IEEE 754 machine computes the same bits.
//!
//! Features: `builder` (default) has the parameters-to-constants part; without it the crate is the step
//! alone. `serde` reads and writes parameters, `log` reports builds through the `log` facade,
//! `link` serves a bank of dampers over a serial line.
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod bank;
#[cfg(feature = "builder")]
mod build;
#[cfg(feature = "builder")]
pub mod characteristic;
mod damper;
mod encoding;
mod error;
#[cfg(all(test, feature = "builder"))]
mod example;
#[cfg(feature = "builder")]
mod hydraulics;
pub mod integrity;
#[cfg(feature = "link")]
pub mod link;
mod math;
#[cfg(feature = "builder")]
mod oil;
pub mod parameters;
mod scalars;
#[cfg(feature = "builder")]
pub mod shim;
mod state;
mod status;
mod step;
mod table;
pub mod telemetry;

pub use bank::step_bank;
#[cfg(feature = "builder")]
pub use build::CheckedParameters;
pub use damper::Damper;
pub use encoding::{ImageError, Loading, SavedStateError, crc_32};
pub use error::{BuildError, ClearanceError};
pub use math::Real;
pub use parameters::DamperParameters;
pub use state::DamperState;
pub use status::Status;
