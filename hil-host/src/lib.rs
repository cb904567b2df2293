//! Desk host of the Dashpot damper.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod commands;
pub mod contact;
pub mod failure;
pub mod output;
pub mod reference;
