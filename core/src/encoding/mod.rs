//! Dampers and states as words and bytes: constants, images, saved states and their checksums.

mod image;
mod saved_state;
mod state_bytes;
mod words;

pub use image::{ImageError, Loading};
pub use saved_state::SavedStateError;
