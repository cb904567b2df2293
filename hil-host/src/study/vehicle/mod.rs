//! A vehicle on a track, from a case: the run, what is recorded of it, how it ends.

mod accelerometer;
pub mod contact;
mod coupled;
pub mod deviations;
pub mod drive;
mod error;
pub mod hunting;
mod indices;
mod inside;
mod outside;
mod overturning;
pub mod recorded;
mod run;
pub mod seeds;
pub mod signals;
pub mod spectra;
mod tick;
pub mod validity;
pub mod verification;

pub use accelerometer::Accelerometer;
pub use coupled::{Coupled, CoupledCase, CoupledVariable};
pub use error::VehicleStudyError;
pub use indices::{
    BodyIndices, Indexer, Indices, Nadal, NoRide, RideIndices, Sample, UnbalancedIndices, WINDOW_M,
    WheelIndices, WheelsetIndices, check_ride,
};
pub use inside::{Beside, DamperEffect, Effect, Forces};
pub use outside::{OutsideError, number_outside};
pub use run::{Ending, Run};
pub use tick::{TickRecord, VehicleTick};
pub use validity::{ValidityWatch, Warning};
