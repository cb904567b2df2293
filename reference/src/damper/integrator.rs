//! Integration of segments by this crate's solver, ESDIRK of order 5.

use super::segment::{Arrival, Integrator, STATES, Segment};
use crate::error::ReferenceError;
use crate::esdirk::{ESDIRK5, Equations, Esdirk, StepEnd, Tolerances};
use crate::linear::Matrix;

/// Tolerance per step, relative to the states and to a segment's scales.
const TOLERANCE: f64 = 1e-12;

/// First step of the first segment, relative to its time scale.
const FIRST_STEP: f64 = 1e-3;

/// Minimum step, relative to the time scale.
const MIN_STEP: f64 = 1e-18;

/// Index of the event function for the distance to the bound.
const BOUND: usize = 0;

/// Default integrator of the reference.
pub(super) struct EsdirkIntegrator {
    solver: Esdirk,
    /// Last step length that the error control chose, before the end of a segment shortened it.
    natural_step: f64,
}

impl Default for EsdirkIntegrator {
    fn default() -> Self {
        let tolerances = Tolerances {
            relative: TOLERANCE,
            absolute: vec![TOLERANCE; STATES],
            min_length: MIN_STEP,
        };
        Self {
            solver: Esdirk::new(&ESDIRK5, tolerances, 2),
            natural_step: FIRST_STEP,
        }
    }
}

/// Converts a state of the solver to a state of a segment.
fn fixed(state: &[f64]) -> [f64; STATES] {
    std::array::from_fn(|k| state[k])
}

struct SegmentEquations<'a>(&'a Segment);

impl Equations for SegmentEquations<'_> {
    fn rates(&mut self, _clock: f64, state: &[f64], rates: &mut [f64]) {
        rates.copy_from_slice(&self.0.rates(&fixed(state)));
    }

    fn jacobian(&mut self, _clock: f64, state: &[f64], jacobian: &mut Matrix) {
        for (row, slope) in self.0.slopes(&fixed(state)).into_iter().enumerate() {
            jacobian.row_mut(row)[0] = slope;
        }
    }

    fn events(&mut self, _clock: f64, state: &[f64], values: &mut [f64]) {
        values.copy_from_slice(&self.0.events(&fixed(state)));
    }
}

impl Integrator for EsdirkIntegrator {
    fn advance(&mut self, segment: &Segment) -> Result<Arrival, ReferenceError> {
        let mut equations = SegmentEquations(segment);
        self.solver
            .restart(&mut equations, 0.0, &segment.initial(), self.natural_step);
        loop {
            let end = self.solver.step(&mut equations, f64::INFINITY);
            let end = end.map_err(|error| ReferenceError::Solver {
                place: format!(
                    " (side {}, seat velocity {} m/s)",
                    segment.side, segment.speed
                ),
                source: error.into(),
            })?;
            self.natural_step = self.solver.wanted_length();
            if let StepEnd::Event { time, index } = end
                && let StepEnd::Event { index, .. } =
                    self.solver.end_at_event(&mut equations, (time, index))
            {
                return Ok(Arrival {
                    state: fixed(self.solver.state()),
                    at_bound: index == BOUND,
                });
            }
        }
    }

    fn steps(&self) -> usize {
        self.solver.counts().steps
    }
}
