#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod accelerometer;
pub mod contact;
mod coupled;
mod error;
pub mod hunting;
mod indices;
mod outside;
mod overturning;
pub mod recorded;
mod run;
pub mod signals;
pub mod spectra;
mod tick;
pub mod validity;
pub mod wear;

pub use accelerometer::Accelerometer;
pub use coupled::{Coupled, CoupledCase, CoupledVariable};
pub use error::VehicleRunError;
pub use indices::{
    BodyIndices, Indexer, Indices, Nadal, NadalWheel, RideError, RideIndices, Sample,
    UnbalancedIndices, WINDOW_M, WheelIndices, WheelsetIndices, check_ride,
};
pub use outside::{OutsideError, outside_index};
pub use run::{Ending, Run};
pub use tick::{TickRecord, VehicleTick};
pub use validity::{ValidityWatch, Warning};
pub use wear::{RunWear, WearIndices, WheelWear};
