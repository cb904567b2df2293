//! The second solver: Radau IIA of order 5 by the `differential-equations` library.

use dashpot_hil::failure::{Failure, Outcome};
use dashpot_hil::reference::{Arrival, Integrator, STATES, Segment};
use differential_equations::prelude::*;

type State = [f64; STATES];

/// Tolerance a step, as the production solver's.
const TOLERANCE: f64 = 1e-10;

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

/// Distance to the nearer of the two events.
struct Nearest<'a>(&'a Segment);

impl Event<f64, State> for Nearest<'_> {
    fn config(&self) -> EventConfig {
        EventConfig::default().terminal()
    }

    fn event(&self, _clock: f64, y: &State) -> f64 {
        let [bound, time] = self.0.events(y);
        bound.min(time)
    }
}

/// Radau5 with its own event location.
#[derive(Default)]
pub struct Radau {
    steps: usize,
}

impl Integrator for Radau {
    fn advance(&mut self, segment: &Segment) -> Outcome<Arrival> {
        let told = |error| Failure::new(format!("Radau: {error:?}"));
        let equations = Equations(segment);
        let method = || {
            ImplicitRungeKutta::radau5()
                .rtol(TOLERANCE)
                .atol(TOLERANCE)
                .max_steps(1_000_000)
        };
        let horizon = 1e9;
        let first = (0.1 * segment.scaled_duration()).min(1e-2);
        let nearest = Nearest(segment);
        let found = IVP::ode(&equations, 0.0, horizon, segment.initial())
            .event(&nearest)
            .method(method().h0(first))
            .solve()
            .map_err(told)?;
        self.steps += found.steps.accepted;
        let clock = *found.t.last().expect("an end");
        // the dense output is of lower order than a step: step to the event instead
        let exact = IVP::ode(&equations, 0.0, clock, segment.initial())
            .method(method().h0(first.min(clock)))
            .solve()
            .map_err(told)?;
        let mut state = *exact.y.last().expect("an end");
        // and close what the dense output left of the event, to first order
        let rates = segment.rates(&state);
        let [bound, time] = segment.events(&state);
        let at_bound = bound < time;
        let ahead = |offset: f64| {
            let moved = std::array::from_fn(|i| state[i] + offset * rates[i]);
            segment.events(&moved)[usize::from(!at_bound)]
        };
        let left = if at_bound { bound } else { time };
        let offset = 1e-6 * segment.scaled_duration();
        let slope = (left - ahead(offset)) / offset;
        let correction = left / slope;
        for i in 0..STATES {
            state[i] += correction * rates[i];
        }
        Ok(Arrival { state, at_bound })
    }

    fn steps(&self) -> usize {
        self.steps
    }
}
