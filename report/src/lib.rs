#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod doubts;
mod error;
pub mod fleet;
pub mod health;
pub mod page;
pub mod plot;
pub mod rounded;
pub mod sheet;
pub mod verdict;

pub use error::DrawError;
