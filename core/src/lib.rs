#![doc = include_str!("../README.md")]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
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
pub mod health;
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
mod unusual;

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
