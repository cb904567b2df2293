//! Desk host of the Dashpot damper: damper files, replay, bench test, verification, wheel-rail contact.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod budget;
mod child;
pub mod commands;
pub mod contact;
pub mod damper_file;
pub mod demonstration;
pub mod excitation;
pub mod export;
pub mod failure;
pub mod input;
pub mod interruption;
pub mod output;
pub mod pacing;
mod page;
pub mod pil;
mod plot;
pub mod published;
pub mod recording;
pub mod reference;
pub mod replay;
pub mod rig;
pub mod shim_valves;
mod temporary;
pub mod timing;
pub mod verification;
