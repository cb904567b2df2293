//! Independent solutions that the fixed steps and the creep laws are checked against, to a stated tolerance.
//!
//! A reference shares only the parameters with the code that it checks; a [`vehicle`] also shares the contact.
//! [`kalker_book`] computes the tables that the recommended creep law reads.
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
