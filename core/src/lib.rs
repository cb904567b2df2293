//! Fixed-step, allocation-free hydraulic damper for hardware-in-the-loop firmware.
#![no_std]
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod error;
pub mod parameters;

pub use error::BuildError;
pub use parameters::DamperParameters;
