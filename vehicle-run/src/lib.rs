#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs)]
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod accelerometer;
mod confirmation;
pub mod contact;
mod coupled;
pub mod damping;
mod end;
mod ending;
mod error;
pub mod hunting;
mod indices;
mod influences;
mod input;
mod outside;
mod outside_loss;
mod overturning;
pub mod recorded;
mod run;
pub mod signals;
pub mod spectra;
mod start;
mod tick;
pub mod validity;
pub mod warning;
pub mod wear;

pub use accelerometer::Accelerometer;
pub use confirmation::confirmed;
pub use coupled::{Coupled, CoupledCase, CoupledVariable};
pub use end::foreseen;
pub use ending::{Ending, Place};
pub use error::VehicleRunError;
pub use indices::{
    BodyIndices, FILTER_HZ, Indexer, Indices, Judged, Nadal, NadalWheel, RideError, RideIndices,
    UnbalancedIndices, WINDOW_M, WheelIndices, WheelsetIndices, check_ride, filtered_names,
};
pub use input::Input;
pub use outside::{OutsideError, outside_index};
pub use outside_loss::{LostDamper, OutsideLoss};
pub use run::Run;
pub use tick::{TickRecord, VehicleTick};
pub use validity::ValidityWatch;
pub use warning::Warning;
pub use wear::{RunWear, WearIndices, WheelWear};
