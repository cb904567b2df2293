//! The second solver: Radau IIA of order 5 by the `differential-equations` library.

use dashpot_hil::failure::{Failure, Outcome};
use dashpot_hil::reference::{Arrival, Integrator, STATES, Segment};
use differential_equations::ode::OrdinaryNumericalMethod;
use differential_equations::prelude::*;

type State = [f64; STATES];

/// Tolerance asked for; the method works to `0.1 tol^(2/3)` a step, of an estimate of lower order
/// than its result.
const TOLERANCE: f64 = 1e-13;

/// Newton's remainder over the tolerance.
const NEWTON_TOLERANCE: f64 = 1e-3;

/// End of the clock, past any event.
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

/// Radau5. It steps past the first event; the event is then located by Newton's method on fresh
/// integrations up to it, since the dense output is of lower order than a step.
#[derive(Default)]
pub struct Radau {
    steps: usize,
}

impl Integrator for Radau {
    fn advance(&mut self, segment: &Segment) -> Outcome<Arrival> {
        let equations = Equations(segment);
        let first = (0.1 * segment.scaled_duration()).min(1e-3);
        let nearest = |y: &State| segment.events(y).into_iter().fold(f64::INFINITY, f64::min);
        let mut solver = ImplicitRungeKutta::radau5()
            .rtol(TOLERANCE)
            .atol(TOLERANCE)
            .newton_tol(NEWTON_TOLERANCE)
            .h0(first);
        solver
            .init(&equations, 0.0, HORIZON, &segment.initial())
            .map_err(told)?;
        while solver.status() == &Status::RejectedStep || nearest(solver.y()) > 0.0 {
            solver.step(&equations).map_err(told)?;
        }
        let (mut before, mut after) = (solver.t_prev(), solver.t());
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            let state = solver.interpolate(middle).map_err(told)?;
            if nearest(&state) > 0.0 {
                before = middle;
            } else {
                after = middle;
            }
        }
        let passed = segment.events(&solver.interpolate(after).map_err(told)?);
        let event = usize::from(passed[0] > passed[1]);
        let mut clock = after;
        for _ in 0..10 {
            let found = IVP::ode(&equations, 0.0, clock, segment.initial())
                .method(
                    ImplicitRungeKutta::radau5()
                        .rtol(TOLERANCE)
                        .atol(TOLERANCE)
                        .newton_tol(NEWTON_TOLERANCE)
                        .h0(first.min(clock)),
                )
                .solve()
                .map_err(told)?;
            self.steps += found.steps.accepted;
            let mut state = *found.y.last().expect("an end");
            let left = segment.events(&state)[event];
            let rates = segment.rates(&state);
            let offset = 1e-6 * clock;
            let ahead = std::array::from_fn(|i| state[i] + offset * rates[i]);
            let correction = left * offset / (left - segment.events(&ahead)[event]);
            if correction.abs() < 1e-7 * clock || left.abs() < 1e-13 {
                // to first order from here on: the rest is below rounding
                for i in 0..STATES {
                    state[i] += correction * rates[i];
                }
                return Ok(Arrival {
                    state,
                    at_bound: event == 0,
                });
            }
            clock += correction;
        }
        Err(Failure::new("Radau: an event is not located"))
    }

    fn steps(&self) -> usize {
        self.steps
    }
}

fn told(error: Error<f64, State>) -> Failure {
    Failure::new(format!("Radau: {error:?}"))
}
