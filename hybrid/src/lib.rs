#![doc = include_str!("../README.md")]

pub mod benchmark;
mod linear;
pub mod plan;
mod sensor;

pub use linear::LinearSystem;
pub use sensor::{Noise, Sensor, SensorSettings};
