//! What is read and written: damper files, recordings, profiles; files whole or not at all.

pub mod damper;
pub mod input;
pub mod output;
pub mod profile;
pub mod recording;
pub mod temporary;
