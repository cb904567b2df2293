//! Equations, tolerances and results of the solver.

use crate::linear::Matrix;

/// Differential equations with events.
pub(crate) trait Equations {
    /// Writes the time derivative of a state.
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]);

    /// Writes the derivative of the rates with respect to the state. An approximation costs iterations, not accuracy.
    fn jacobian(&mut self, time: f64, state: &[f64], jacobian: &mut Matrix);

    /// Writes the event functions. An event occurs when a function falls to zero or below.
    fn events(&mut self, time: f64, state: &[f64], values: &mut [f64]);
}

/// End of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepEnd {
    /// At a time chosen by the error control.
    Free,
    /// At the stop time.
    Stop,
    /// Beyond an event within the step.
    Event {
        /// Time of the event.
        time: f64,
        /// Index of the event function.
        index: usize,
    },
}

/// The tolerance cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "step length {length} at {time} is below the minimum of {min_length}; the tolerance cannot be reached"
)]
pub(crate) struct StepTooSmall {
    pub(super) length: f64,
    pub(super) time: f64,
    pub(super) min_length: f64,
}

/// Counts since the solver was created.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Accepted steps.
    pub(crate) steps: usize,
    /// Steps rejected because of their error.
    pub(crate) rejected: usize,
    /// Factorisations of the iteration matrix.
    pub(crate) factorisations: usize,
}

/// Tolerances of a solver.
#[derive(Clone, Debug)]
pub(crate) struct Tolerances {
    /// Tolerance relative to each state.
    pub(crate) relative: f64,
    /// Absolute tolerance of each state, added to the relative one.
    pub(crate) absolute: Vec<f64>,
    /// Minimum step length; a shorter step is an error.
    pub(crate) min_length: f64,
}

impl Tolerances {
    /// Mean square of a vector divided by the tolerances at a state.
    pub(super) fn mean_square(&self, vector: &[f64], state: &[f64]) -> f64 {
        let squares = vector.iter().zip(state.iter().zip(&self.absolute));
        let sum: f64 = squares
            .map(|(x, (state, absolute))| (x / (state.abs() * self.relative + absolute)).powi(2))
            .sum();
        sum / vector.len() as f64
    }
}
