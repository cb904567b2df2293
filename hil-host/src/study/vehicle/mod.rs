//! A vehicle on a track, from a case: the run, what is recorded of it, how it ends.

pub mod contact;
pub mod deviations;
mod error;
pub mod hunting;
mod indices;
mod inside;
mod ride;
mod run;
pub mod seeds;
pub mod signals;
pub mod verification;

pub use error::VehicleStudyError;
pub use indices::{BodyIndices, Indexer, Indices, WheelIndices, WheelsetIndices};
pub use inside::{Beside, DamperEffect, Effect, Forces};
pub use ride::RideIndices;
pub use run::{Ending, Run};
