#![doc = include_str!("../README.md")]

pub mod actuator;
pub mod benchmark;
mod compensation;
mod coupling;
mod linear;
mod loop_factor;
pub mod plan;
pub mod rig;
mod sensor;
mod specimen;

pub use compensation::{AnyCompensator, Compensation};
pub use coupling::{CoupledTick, Coupling};
pub use linear::LinearSystem;
pub use loop_factor::LoopFactor;
pub use sensor::{Noise, Sensor, SensorSettings};
pub use specimen::Specimen;
