//! Repetition of a step that passed an event, so that it ends at the event.
//!
//! The interpolation has order 3. A method of higher order takes steps over which the interpolation is less accurate
//! than the step, so the state at the event needs a step of its own.

use super::matrix::Cause;
use super::{Equations, Esdirk, Guess, StepEnd};

/// Maximum number of repetitions.
const MAX_REPETITIONS: usize = 12;

/// Change of the length, relative to the length, that ends the search.
const RELATIVE_CHANGE: f64 = 100.0 * f64::EPSILON;

/// Value of an event function, relative to its value at the start of the step, below which its event came first.
const PASSED: f64 = -1e-12;

impl Esdirk {
    /// Repeats the last step, which passed event `index` at about `time`, with the length that ends it at the first
    /// event. The state at the event is [`Self::state`].
    ///
    /// The functions must have the scale of the states: a function that stays within the relative tolerance around zero
    /// has reached zero, for the solution is not more accurate. A solution that fades towards zero does so.
    ///
    /// If an iteration diverges, the solver goes back to the start of the step, and the next step is shorter.
    pub(crate) fn end_at_event(
        &mut self,
        equations: &mut impl Equations,
        (time, mut index): (f64, usize),
    ) -> StepEnd {
        let full = self.time - self.start_time;
        let (mut values, mut at_start) = (self.bracket.low.clone(), self.bracket.low.clone());
        equations.events(self.start_time, &self.start, &mut at_start);
        std::mem::swap(&mut self.start, &mut self.state);
        self.counts.steps -= 1;
        self.time = self.start_time;
        for (rate, increment) in self.rates.iter_mut().zip(&self.increments[0]) {
            *rate = increment / full;
        }
        // Secants through the last two lengths; the first one leads through the start of the step.
        let mut length = time - self.time;
        let (mut other, mut other_value) = (0.0, at_start[index]);
        let mut scale = length / full;
        self.update_matrix(equations, length, Cause::ErrorTooLarge);
        for repetition in 1..=MAX_REPETITIONS {
            if !self.solve_stages(equations, length, Guess::Last { scale }) {
                break;
            }
            equations.events(self.time + length, &self.stage, &mut values);
            let mut change = secant(length, values[index], other, other_value);
            let is_zero =
                repetition == MAX_REPETITIONS && values[index].abs() <= self.tolerances.relative;
            if change.abs() > RELATIVE_CHANGE * length && !is_zero {
                (other, other_value) = (length, values[index]);
            } else {
                let passed = values
                    .iter()
                    .zip(&at_start)
                    .position(|(v, start)| *v < PASSED * start);
                let Some(earlier) = passed.filter(|earlier| *earlier != index) else {
                    self.accept(length, 1.0, true);
                    return StepEnd::Event {
                        time: self.time,
                        index,
                    };
                };
                (index, other, other_value) = (earlier, 0.0, at_start[earlier]);
                change = secant(length, values[index], other, other_value);
            }
            let next = (length + change).clamp(0.01 * length, full);
            scale = next / length;
            length = next;
        }
        self.bracket.low = at_start;
        self.wanted = 0.5 * length;
        self.update_matrix(equations, self.wanted, Cause::Restart);
        StepEnd::Free
    }
}

/// Change of the length to the zero of the line through two lengths with their values.
fn secant(length: f64, value: f64, other: f64, other_value: f64) -> f64 {
    value * (length - other) / (other_value - value)
}
