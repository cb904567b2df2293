#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod estimate;
mod grid;
mod law;
mod patch;
pub mod procedure;
mod removal;
mod strips;
mod wear;

pub use estimate::{CellWear, WearEstimate};
pub use grid::{CELL_M, WearGrid};
pub use law::{Archard, TGamma, WearLaw};
pub use patch::WearingPatch;
pub use removal::{RemovalError, removed};
pub use strips::STRIPS;
pub use wear::Wear;
