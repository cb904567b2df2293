//! The solution within the last step: interpolation and events.

use super::{Equations, Esdirk, StepEnd};

impl Esdirk {
    /// Finds the first event within the last step.
    pub(super) fn event(&mut self, equations: &mut impl Equations) -> Option<StepEnd> {
        equations.events(self.time, &self.state, &mut self.bracket.high);
        let mut bracket = std::mem::take(&mut self.bracket);
        let mut state = std::mem::take(&mut self.interpolated);
        let crossing = bracket.locate((self.start_time, self.time), |time, values| {
            self.interpolate(time, &mut state);
            equations.events(time, &state, values);
        });
        if crossing.is_none() {
            bracket.advance();
        }
        (self.bracket, self.interpolated) = (bracket, state);
        crossing.map(|crossing| StepEnd::Event {
            time: crossing.time,
            index: crossing.index,
        })
    }

    /// Writes the state at a time within the last step: a cubic through the states and rates at both ends.
    pub(crate) fn interpolate(&self, time: f64, state: &mut [f64]) {
        let share = (time - self.start_time) / (self.time - self.start_time);
        let left = 1.0 - share;
        let [first, .., last] = self.increments.as_slice() else {
            return;
        };
        for (k, state) in state.iter_mut().enumerate() {
            let (start, end) = (self.start[k], self.state[k]);
            let bend = (left - share) * (end - start) - left * first[k] + share * last[k];
            *state = left * start + share * end - share * left * bend;
        }
    }
}
