#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod budget;
mod error;
pub mod handover;
pub mod pacing;
pub mod timing;

pub use error::RealtimeError;
pub use error::{listed, stopped};
