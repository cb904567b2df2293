//! Second solver: Radau IIA of order 5 from the `differential-equations` library.

use dashpot_reference::ReferenceError;
use dashpot_reference::damper::{Arrival, Integrator, STATES, Segment};
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::prelude::*;

type State = [f64; STATES];

/// Requested tolerance. Per step, the method keeps its error estimate, which is of lower order than its result, below
/// `0.1 tol^(2/3)`.
const TOLERANCE: f64 = 1e-14;

/// Remaining error of the Newton iteration, relative to the tolerance.
const NEWTON_TOLERANCE: f64 = 1e-3;

/// End of the clock, later than any event.
const HORIZON: f64 = 1e9;

struct Equations<'a>(&'a Segment);

impl ODE<f64, State> for Equations<'_> {
    fn diff(&self, _clock: f64, y: &State, rates: &mut State) {
        *rates = self.0.rates(y);
    }

    fn jacobian(&self, _clock: f64, y: &State, jacobian: &mut Matrix<f64>) {
        for (i, slope) in self.0.slopes(y).into_iter().enumerate() {
            jacobian[(i, 0)] = slope;
            jacobian[(i, 1)] = 0.0;
            jacobian[(i, 2)] = 0.0;
        }
    }
}

/// Radau5. Each step uses a new solver, because a reused one keeps the factorisation of another step size, which makes
/// its error estimate wrong.
///
/// A step may pass an event; Newton's method on the length of that step then locates it. Dense output is not used.
pub struct Radau {
    steps: usize,
    natural_step: f64,
}

impl Default for Radau {
    fn default() -> Self {
        Self {
            steps: 0,
            natural_step: 1e-3,
        }
    }
}

impl Radau {
    /// Takes one accepted step of at most `length`; returns its length and the state at its end.
    fn step(
        &mut self,
        segment: &Segment,
        from: &State,
        length: f64,
    ) -> Result<(f64, State), ReferenceError> {
        let equations = Equations(segment);
        let mut solver = ImplicitRungeKutta::radau5()
            .rtol(TOLERANCE)
            .atol(TOLERANCE)
            .newton_tol(NEWTON_TOLERANCE)
            .h0(length);
        solver
            .init(&equations, 0.0, HORIZON, from)
            .map_err(solver_error)?;
        loop {
            solver.step(&equations).map_err(solver_error)?;
            if solver.status() != &Status::RejectedStep {
                self.steps += 1;
                self.natural_step = solver.h();
                return Ok((solver.t(), *solver.y()));
            }
        }
    }

    /// Returns the state after `length`.
    fn march(
        &mut self,
        segment: &Segment,
        from: &State,
        length: f64,
    ) -> Result<State, ReferenceError> {
        let (mut done, mut state) = (0.0, *from);
        while length - done > 1e-15 * length {
            let (step, next) = self.step(segment, &state, length - done)?;
            done += step;
            state = next;
        }
        Ok(state)
    }
}

impl Integrator for Radau {
    fn advance(&mut self, segment: &Segment) -> Result<Arrival, ReferenceError> {
        let mut before = segment.initial();
        let (mut length, passed) = loop {
            let (length, after) = self.step(segment, &before, self.natural_step)?;
            if segment.events(&after).into_iter().any(|left| left <= 0.0) {
                break (length, after);
            }
            before = after;
        };
        let natural_step = self.natural_step;
        // The first event is the one that is reached at the smallest fraction of the step.
        let (from, to) = (segment.events(&before), segment.events(&passed));
        let fraction = |i: usize| from[i] / (from[i] - to[i]);
        let mut event = usize::from(to[0] > 0.0 || (to[1] <= 0.0 && fraction(1) < fraction(0)));
        let mut tries = 0;
        let (mut low, mut high) = (0.0, length);
        let mut state = passed;
        let arrival = loop {
            let left = segment.events(&state)[event];
            if left > 0.0 {
                low = length;
            } else {
                high = length;
            }
            if left.abs() < 1e-14 || high - low < 1e-14 * high || tries > 40 {
                let other = segment.events(&state)[1 - event];
                if other < -1e-13 {
                    // The other event comes first.
                    (event, tries, low, high) = (1 - event, 0, 0.0, length);
                    continue;
                }
                break Arrival {
                    state,
                    at_bound: event == 0,
                };
            }
            let rates = segment.rates(&state);
            let offset = 1e-6 * length;
            let ahead = std::array::from_fn(|i| state[i] + offset * rates[i]);
            let newton = length + left * offset / (left - segment.events(&ahead)[event]);
            length = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            state = self.march(segment, &before, length)?;
            tries += 1;
        };
        self.natural_step = natural_step;
        Ok(arrival)
    }

    fn steps(&self) -> usize {
        self.steps
    }
}

fn solver_error(error: Error<f64, State>) -> ReferenceError {
    ReferenceError::Solver {
        place: String::new(),
        source: format!("Radau: {error:?}").into(),
    }
}
