//! Hybrid tests: the transfer system between a simulated vehicle and an actuator, and its motion filter.

mod any;
mod compensator;
mod motion;
mod system;

pub use motion::MotionFilter;
pub use system::TransferSystem;

use crate::class::Class;

/// A class of `dashpot._hybrid`.
const fn class(name: &'static str) -> Class {
    Class::new("dashpot._hybrid", name)
}
