#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod contact;
pub mod creep;
pub mod indices;
mod math;
pub mod profile;
mod setters;
pub mod track;
pub mod vehicle;

pub use math::{fuses_multiplication, without_fused_multiplication};
