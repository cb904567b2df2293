#![doc = include_str!("../README.md")]

pub mod actuator;
pub mod benchmark;
mod linear;
mod sensor;

pub use linear::LinearSystem;
pub use sensor::{Noise, Sensor, SensorSettings};
