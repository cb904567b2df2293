#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod actuator;
pub mod case;
pub mod contact;
pub mod damper;
mod error;
pub mod harmonic;
mod hexadecimal;
pub mod input;
mod lines;
mod nanosecond;
pub mod output;
mod overrides;
pub mod profile;
mod scalar;
pub mod sheet;
mod shipped;
pub mod states;
pub mod status_bits;
pub mod study;
pub mod temporary;
pub mod track;
pub mod vehicle;

pub use error::FileError;
pub use hexadecimal::hexadecimal;
pub use nanosecond::nearest_nanosecond;
pub use overrides::did_you_mean;
pub use scalar::Scalar;
pub use shipped::UnknownName;
