//! Independent solutions that the fixed steps are checked against: adaptive, to a stated tolerance.
//!
//! They share the parameters with what they check, and nothing else.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod damper;
pub mod deviation;
mod error;
pub mod kalker_book;
pub mod rolling_contact;

pub use error::ReferenceError;
