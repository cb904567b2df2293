//! Integration of a vehicle's equations, restarted at the edges of the elements' laws and of the track.

use dashpot_rail::contact::PatchSource;
use dashpot_rail::creep::CreepLaw;

use super::Statistics;
use super::equations::{Equations, N, Outcome, Situation};
use crate::error::ReferenceError;
use crate::esdirk::{self, ESDIRK3, Esdirk, StepEnd, StepTooSmall, Tolerances};
use crate::linear::Matrix;

/// Displacements (m or rad) and velocities (m/s or rad/s) below which the tolerance is absolute.
const SCALES: [f64; 2] = [1e-3, 0.05];

/// Change of state, relative to the tolerance, within which the rates are linearised.
const LINEAR_RATIO: f64 = 0.02;

/// First step (s).
const FIRST_STEP_S: f64 = 1e-6;

/// Minimum step (s).
const MIN_STEP_S: f64 = 1e-16;

/// Minimum time between two restarts at edges of the track (s).
const MIN_EDGE_INTERVAL_S: f64 = 1e-9;

/// Equations for the solver, with data kept between evaluations.
struct Problem<'e, 'a, L, S: PatchSource> {
    equations: &'e Equations<'a, L, S>,
    /// Constant part of the Jacobian.
    linear: Matrix,
    situation: Situation<'a>,
    outcome: Outcome,
    /// Last Jacobian since the restart.
    jacobian: Option<Matrix>,
    /// Time, state and rates of the last evaluation.
    last: (f64, Vec<f64>, Vec<f64>),
    tolerance: f64,
    evaluations: usize,
}

impl<L: CreepLaw, S: PatchSource> Problem<'_, '_, L, S> {
    fn evaluate(&mut self, time: f64, state: &[f64], rates: &mut [f64]) {
        self.evaluations += 1;
        let outcome = &mut self.outcome;
        self.equations
            .outcome(&mut self.situation, time, state, outcome);
        let bodies = self.equations.bodies();
        for body in 0..bodies {
            for k in 0..N {
                rates[N * body + k] = outcome.rates[body][k];
                rates[N * (bodies + body) + k] = outcome.accelerations[body][k];
            }
        }
        let pistons = 2 * N * bodies;
        rates[pistons..pistons + self.equations.dampers]
            .copy_from_slice(&outcome.piston_velocities);
        if let Some(rails) = &self.equations.rails {
            let wheelsets = self.equations.wheelsets.iter().zip(&outcome.contacts);
            for (wheelset, (rolling, contact)) in wheelsets.enumerate() {
                let standing = &rolling.standing.wheel_forces;
                rails.write_rates(state, wheelset, contact, standing, rates);
            }
        }
    }
}

impl<L: CreepLaw, S: PatchSource> esdirk::Equations for Problem<'_, '_, L, S> {
    /// Writes the rates at a state; close to the last evaluated state, they are extrapolated with the Jacobian.
    ///
    /// A state is close if its distance is below [`LINEAR_RATIO`] times the tolerance.
    ///
    /// The contact tables are rounded to `f32`, so forces jump by about 1e-7 of their magnitude at the borders of
    /// their cells; one border is at the track's centre. Without the extrapolation, an iteration that converges to a
    /// border would jump between the two sides forever.
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) {
        let (last_time, last_state, last_rates) = &self.last;
        if *last_time == time
            && let Some(jacobian) = &self.jacobian
            && self.equations.distance(last_state, state, self.tolerance) < LINEAR_RATIO
        {
            let step: Vec<f64> = state
                .iter()
                .zip(last_state)
                .map(|(to, from)| to - from)
                .collect();
            jacobian.times(&step, rates);
            for (rate, last) in rates.iter_mut().zip(last_rates) {
                *rate += last;
            }
            return;
        }
        self.evaluate(time, state, rates);
        self.last = (time, state.to_vec(), rates.to_vec());
    }

    fn jacobian(&mut self, time: f64, state: &[f64], jacobian: &mut Matrix) {
        let slopes = self
            .equations
            .slopes(&self.linear, &mut self.situation, time, state);
        jacobian.clone_from(&slopes);
        self.jacobian = Some(slopes);
    }

    fn events(&mut self, time: f64, state: &[f64], values: &mut [f64]) {
        let margins = self.equations.margins(&mut self.situation, time, state);
        values.copy_from_slice(&margins);
    }
}

impl<L: CreepLaw, S: PatchSource> Equations<'_, L, S> {
    /// Magnitude of a state below which the tolerance is absolute.
    fn scale(&self, k: usize) -> f64 {
        let coordinates = N * self.bodies();
        let is_velocity = (coordinates..2 * coordinates).contains(&k)
            || self.rails.is_some_and(|rails| rails.is_velocity(k));
        SCALES[usize::from(is_velocity)]
    }

    /// Root mean square distance of two states, divided by the tolerance.
    fn distance(&self, from: &[f64], to: &[f64], tolerance: f64) -> f64 {
        let over = |(k, (from, to)): (usize, (&f64, &f64))| {
            let allowed = tolerance * (from.abs() + self.scale(k));
            ((to - from) / allowed).powi(2)
        };
        let squares: f64 = from.iter().zip(to).enumerate().map(over).sum();
        (squares / self.size() as f64).sqrt()
    }
}

/// Runs from `start` at time 0 and calls `on_sample` with the situation, time and state at each of the increasing
/// `times`.
pub(super) fn run<'a, L: CreepLaw, S: PatchSource>(
    equations: &Equations<'a, L, S>,
    situation: Situation<'a>,
    start: &[f64],
    times: &[f64],
    tolerance: f64,
    mut on_sample: impl FnMut(&mut Situation<'a>, f64, &[f64]),
) -> Result<Statistics, ReferenceError> {
    let mut problem = Problem {
        equations,
        linear: equations.linear_slopes(),
        situation,
        outcome: Outcome::default(),
        jacobian: None,
        last: (f64::NAN, vec![], vec![]),
        tolerance,
        evaluations: 0,
    };
    let tolerances = Tolerances {
        relative: tolerance,
        absolute: (0..equations.size())
            .map(|k| tolerance * equations.scale(k))
            .collect(),
        min_length: MIN_STEP_S,
    };
    let mut solver = Esdirk::new(&ESDIRK3, tolerances, 2 * equations.ranged.len());
    let mut statistics = Statistics::default();
    let mut waiting = times.iter().copied().peekable();
    while let Some(time) = waiting.next_if(|time| *time <= 0.0) {
        on_sample(&mut problem.situation, time, start);
    }
    let Some(end) = times.last().copied().filter(|end| *end > 0.0) else {
        return Ok(statistics);
    };
    let edges = problem.situation.path.edges(end);
    let mut state = start.to_vec();
    let mut sample = state.clone();
    let (mut now, mut step) = (0.0, FIRST_STEP_S);
    for edge in edges.into_iter().chain([end]) {
        if edge < now + MIN_EDGE_INTERVAL_S {
            continue;
        }
        problem.situation.enter(0.5 * (now + edge));
        // The solver restarts at each event until the edge is reached.
        let mut is_at_edge = false;
        while !is_at_edge {
            statistics.events += equations.settle(&mut problem.situation, now, &mut state);
            problem.jacobian = None;
            solver.restart(&mut problem, now, &state, step);
            let step_end = loop {
                let step_end = solver
                    .step(&mut problem, edge)
                    .map_err(|error| failed(now, error))?;
                now = match step_end {
                    StepEnd::Event { time, .. } => time,
                    StepEnd::Free | StepEnd::Stop => solver.time(),
                };
                while let Some(time) = waiting.next_if(|time| *time <= now) {
                    solver.interpolate(time, &mut sample);
                    on_sample(&mut problem.situation, time, &sample);
                }
                if step_end != StepEnd::Free {
                    break step_end;
                }
            };
            step = solver.wanted_length();
            if step_end == StepEnd::Stop {
                state.copy_from_slice(solver.state());
                is_at_edge = true;
            } else {
                solver.interpolate(now, &mut state);
                is_at_edge = edge - now < MIN_EDGE_INTERVAL_S;
            }
        }
    }
    for time in waiting {
        on_sample(&mut problem.situation, time, &state);
    }
    let counts = solver.counts();
    statistics.steps = counts.steps;
    statistics.rejected = counts.rejected;
    statistics.factorisations = counts.factorisations;
    statistics.evaluations = problem.evaluations;
    Ok(statistics)
}

fn failed(time: f64, error: StepTooSmall) -> ReferenceError {
    ReferenceError::Solver {
        place: format!(" (at {time} s)"),
        source: error.into(),
    }
}
