#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod budget;
mod error;
pub mod handover;
pub mod limits;
pub mod options;
pub mod pacing;
pub mod stop;
pub mod timing;

pub use error::RealtimeError;
pub use error::{listed, stopped};
