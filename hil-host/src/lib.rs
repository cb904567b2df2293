//! Desk host of the Dashpot damper: replay, bench test, verification, processor in the loop.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod commands;
pub mod files;
pub mod realtime;
pub mod report;
pub mod study;
pub mod target;
