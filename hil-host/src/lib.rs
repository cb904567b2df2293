#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod commands;
pub mod files;
pub mod realtime;
pub mod remedy;
pub mod report;
pub mod study;
pub mod target;
