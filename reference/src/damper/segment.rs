//! The smooth problem a stiff solver gets: one direction, one velocity of the seats, one range
//! between valve openings.
//!
//! State: coordinate of the chamber pressure, time since the start, piston travel since the start,
//! each over its scale. Independent variable: a clock that runs with time but slows where the
//! pressure meets zero, so that the square root of the flow laws is never met as a singularity.

use std::rc::Rc;

use super::side::Side;
use crate::error::ReferenceError;

/// Number of states.
pub const STATES: usize = 3;

/// Magnitudes that make the states of order one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Typical velocity of the seats (m/s).
    pub(super) velocity: f64,
    /// Coordinate of the typical force, each side.
    pub(super) coordinate: [f64; 2],
    /// Relaxation time of the chain at that force (s).
    pub(super) time: f64,
    /// Stretch at that force (m).
    pub(super) stretch: f64,
}

/// One smooth piece of motion, to be integrated until its time is over or a bound is met.
#[derive(Clone, Debug)]
pub struct Segment {
    pub(super) sides: Rc<[Side; 2]>,
    pub(super) scales: Scales,
    /// 0 extension, 1 compression.
    pub(super) side: usize,
    /// Velocity of the seats in the working direction (m/s).
    pub(super) speed: f64,
    /// Coordinate at the start.
    pub(super) start: f64,
    /// Coordinate of the next opening, of zero or of yielding, in the direction of motion.
    pub(super) bound: f64,
    /// Time left in the piece (s).
    pub(super) duration: f64,
    /// Coordinate at which the clock has slowed.
    pub(super) knee: f64,
}

impl Segment {
    /// Start of the scaled state.
    pub fn initial(&self) -> [f64; STATES] {
        [self.start / self.scales.coordinate[self.side], 0.0, 0.0]
    }

    /// Derivative of the scaled state along the scaled clock.
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

    /// Derivative of `rates` with respect to the first state, the only one they depend on; by
    /// central differences, good for a Newton iteration.
    pub fn slopes(&self, state: &[f64; STATES]) -> [f64; STATES] {
        let floor = self.knee / self.scales.coordinate[self.side];
        let step = 1e-6 * state[0].abs().max(floor).max(1e-9);
        let at = |offset: f64| self.rates(&[state[0] + offset, state[1], state[2]]);
        let (ahead, behind) = (at(step), at(-step));
        std::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * step))
    }

    /// Event functions, both positive at the start: distance to the bound and time left.
    pub fn events(&self, state: &[f64; STATES]) -> [f64; 2] {
        let scale = self.scales.coordinate[self.side];
        let distance = (self.bound - self.start).signum() * (self.bound / scale - state[0]);
        [distance, self.scaled_duration() - state[1]]
    }

    /// Time left over its scale: the least the clock advances.
    pub fn scaled_duration(&self) -> f64 {
        self.duration / self.scales.time
    }
}

/// Where a segment ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arrival {
    /// Scaled state at the end.
    pub state: [f64; STATES],
    /// True when the bound was met before the time was over.
    pub at_bound: bool,
}

/// A stiff solver of segments.
pub trait Integrator {
    /// Integrate `segment` from its start to the first of its events.
    ///
    /// # Errors
    /// The solver cannot reach the tolerance.
    fn advance(&mut self, segment: &Segment) -> Result<Arrival, ReferenceError>;

    /// Steps accepted so far.
    fn steps(&self) -> usize;
}
