#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod damper;
pub mod deviation;
mod error;
mod esdirk;
pub mod kalker_book;
mod linear;
pub mod probing;
pub mod rolling_contact;
pub mod vehicle;

pub use error::ReferenceError;
