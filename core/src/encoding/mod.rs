//! Dampers and states as words and bytes: constants, images, saved states and their checksums.

pub(crate) mod checksum;
mod image;
pub(crate) mod revision;
mod saved_state;
mod state_bytes;
mod words;

pub use checksum::crc_32;
pub use image::{ImageError, Loading};
pub use saved_state::SavedStateError;
