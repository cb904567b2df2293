//! A smooth problem for the stiff solver: one direction, one seat velocity, one range between valve openings.
//!
//! The states are the coordinate of the chamber pressure, the time since the start and the piston travel since the
//! start, each divided by its scale. The independent variable is a transformed time, the clock: it slows down as the
//! pressure approaches zero, which removes the singularity of the square root in the flow laws.

use std::rc::Rc;

use super::side::Side;
use crate::error::ReferenceError;

/// Number of states.
pub const STATES: usize = 3;

/// Magnitudes that scale the states to order one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Typical velocity of the seats (m/s).
    pub(super) velocity: f64,
    /// Coordinate of the typical force of each side.
    pub(super) coordinate: [f64; 2],
    /// Relaxation time of the chain at that force (s).
    pub(super) time: f64,
    /// Stretch at that force (m).
    pub(super) stretch: f64,
}

/// One smooth piece of motion. It ends when its time is over or a bound is reached.
#[derive(Clone, Debug)]
pub struct Segment {
    pub(super) sides: Rc<[Side; 2]>,
    pub(super) scales: Scales,
    /// 0 for extension, 1 for compression.
    pub(super) side: usize,
    /// Velocity of the seats in the working direction (m/s).
    pub(super) speed: f64,
    /// Coordinate at the start.
    pub(super) start: f64,
    /// Next coordinate in the direction of change at which a valve opens, the pressure is zero or the damper yields.
    pub(super) bound: f64,
    /// Remaining time of the piece (s).
    pub(super) duration: f64,
    /// Coordinate below which the clock slows down.
    pub(super) knee: f64,
}

impl Segment {
    /// Scaled state at the start.
    pub fn initial(&self) -> [f64; STATES] {
        [self.start / self.scales.coordinate[self.side], 0.0, 0.0]
    }

    /// Derivative of the scaled state with respect to the scaled clock.
    pub fn rates(&self, state: &[f64; STATES]) -> [f64; STATES] {
        let scale = self.scales.coordinate[self.side];
        let [coordinate, time, travel] =
            self.sides[self.side].rates(state[0] * scale, self.speed, self.knee);
        [
            coordinate * self.scales.time / scale,
            time,
            travel * self.scales.time / self.scales.stretch,
        ]
    }

    /// Derivative of [`Self::rates`] with respect to the first state, the only one on which they depend.
    ///
    /// Central differences are accurate enough for a Newton iteration.
    pub fn slopes(&self, state: &[f64; STATES]) -> [f64; STATES] {
        let floor = self.knee / self.scales.coordinate[self.side];
        let step = 1e-6 * state[0].abs().max(floor).max(1e-9);
        let at = |offset: f64| self.rates(&[state[0] + offset, state[1], state[2]]);
        let (ahead, behind) = (at(step), at(-step));
        std::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * step))
    }

    /// Event functions, both positive at the start: the distance to the bound and the remaining time.
    pub fn events(&self, state: &[f64; STATES]) -> [f64; 2] {
        let scale = self.scales.coordinate[self.side];
        let distance = (self.bound - self.start).signum() * (self.bound / scale - state[0]);
        [distance, self.scaled_duration() - state[1]]
    }

    /// Remaining time over its scale, a lower bound for the time on the clock.
    pub fn scaled_duration(&self) -> f64 {
        self.duration / self.scales.time
    }
}

/// End of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Scaled state at the end.
    pub state: [f64; STATES],
    /// True if the bound was reached before the time was over.
    pub at_bound: bool,
}

/// A stiff solver of segments.
pub trait Integrator {
    /// Integrates `segment` from its start to its first event.
    ///
    /// # Errors
    /// The solver cannot reach the tolerance.
    fn advance(&mut self, segment: &Segment) -> Result<Arrival, ReferenceError>;

    /// Steps accepted so far.
    fn steps(&self) -> usize;
}
