//! The trait of compensators.

use super::motion::Motion;

/// Computes the command of an actuator so that it reaches the desired displacement in time.
///
/// In each tick, [`command_m`](Self::command_m) is called once and then [`observe`](Self::observe). Both must take a
/// fixed time. A [`Guard`](super::Guard) checks each command before it is sent, so a compensator that goes wrong cannot
/// make the command jump.
///
/// ```
/// use dashpot_core::hybrid::{Compensator, Motion};
///
/// /// Corrects the gain of an actuator that always moves 3 % too little.
/// struct Larger;
///
/// impl Compensator for Larger {
///     fn command_m(&mut self, desired: &Motion) -> f32 {
///         desired.displacement_m / 0.97
///     }
///     fn rest_at(&mut self, _displacement_m: f32) {}
/// }
///
/// assert!((Larger.command_m(&Motion::at_rest(0.0097)) - 0.01).abs() < 1e-8);
/// ```
pub trait Compensator {
    /// Returns the command (m) of this tick for the desired motion.
    fn command_m(&mut self, desired: &Motion) -> f32;

    /// Learns from a tick: the command that was sent (m), after limits, and the displacement (m) that was measured at
    /// the beginning of the tick. Not called in ticks without a valid measurement.
    fn observe(&mut self, sent_m: f32, measured_m: f32) {
        let _ = (sent_m, measured_m);
    }

    /// Forgets the past: the actuator is at rest at a displacement (m).
    fn rest_at(&mut self, displacement_m: f32);
}

/// Sends the desired displacement as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Uncompensated;

impl Compensator for Uncompensated {
    fn command_m(&mut self, desired: &Motion) -> f32 {
        desired.displacement_m
    }

    fn rest_at(&mut self, _: f32) {}
}
