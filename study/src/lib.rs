#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod loaded_wheelset;
pub mod profile_ends;
pub mod sweep;
pub mod verification;
pub mod wheelset_geometry;
