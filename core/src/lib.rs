#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod bank;
mod bins;
#[cfg(feature = "builder")]
mod build;
#[cfg(feature = "builder")]
pub mod characteristic;
mod checksum;
mod damper;
mod encoding;
mod error;
#[cfg(test)]
#[cfg(feature = "builder")]
mod example;
pub mod health;
pub mod hybrid;
#[cfg(feature = "builder")]
mod hydraulics;
pub mod integrity;
#[cfg(feature = "link")]
pub mod link;
mod math;
#[cfg(feature = "builder")]
mod oil;
pub mod parameters;
mod real;
mod revision;
mod scalars;
#[cfg(feature = "builder")]
pub mod shim;
mod stages;
mod state;
mod status;
mod step;
mod table;
#[cfg(feature = "builder")]
mod table_check;
pub mod telemetry;
mod unusual;
#[cfg(feature = "xcp")]
pub mod xcp;

pub use bank::{VectorWidth, step_bank, step_bank_with};
#[cfg(feature = "builder")]
pub use build::CheckedParameters;
pub use checksum::crc_32;
pub use damper::{ClearanceError, Damper};
pub use encoding::{ImageError, Loading, SavedStateError};
pub use error::BuildError;
pub use parameters::DamperParameters;
pub use real::Real;
pub use state::DamperState;
pub use status::Status;
