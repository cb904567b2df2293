//! What is read and written: damper, vehicle, track, case, study and sheet files, recordings, profiles, saved states; files whole or not at all.

pub mod case;
#[cfg(feature = "parquet")]
pub mod columns;
pub mod damper;
mod error;
pub mod input;
mod lines;
pub mod output;
mod overrides;
pub mod profile;
pub mod recording;
pub mod sheet;
mod shipped;
pub mod states;
pub mod status_bits;
pub mod study;
pub mod temporary;
pub mod track;
pub mod vehicle;

pub use error::FileError;
pub(crate) use overrides::nearest;
pub use shipped::UnknownName;
