#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod loaded_wheelset;
pub mod modes;
pub mod profile_ends;
pub mod sweep;
pub mod verification;
pub mod wheelset_geometry;
