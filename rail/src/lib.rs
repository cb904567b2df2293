#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod contact;
pub mod creep;
pub mod indices;
mod math;
pub mod profile;
mod setters;
pub mod track;
pub mod vehicle;

pub use math::eigenvalues::eigenvalues;
pub use math::with_narrowest_vectors;
