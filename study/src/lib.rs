#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod sweep;
pub mod verification;
pub mod wheelset_geometry;
