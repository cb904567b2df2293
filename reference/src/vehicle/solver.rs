//! The equations by ESDIRK34 of diffsol: adaptive, L-stable, restarted at the edges of the elements' laws and of the track.

use std::cell::RefCell;

use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquationsImplicit,
    OdeSolverMethod, OdeSolverProblem, OdeSolverState, OdeSolverStopReason,
};

use dashpot_rail::contact::PatchSource;
use dashpot_rail::creep::CreepLaw;

use super::Statistics;
use super::equations::{Equations, N, Outcome, Situation};
use super::slopes::Matrix;
use crate::error::ReferenceError;

/// Displacements (m or rad) and velocities (m/s or rad/s) below which the tolerance is absolute.
const SCALES: [f64; 2] = [1e-3, 0.05];

/// Share of the tolerance over which the rates are taken as linear.
const LINEAR_SHARE: f64 = 0.02;

/// First step (s).
const FIRST_STEP_S: f64 = 1e-6;

/// Least time between two restarts at edges of the track (s).
const LEAST_APART_S: f64 = 1e-9;

type Vector = NalgebraVec<f64>;
type Dense = NalgebraMat<f64>;

/// What the closures of a problem look at.
struct Shared<'e, 'a, L, S: PatchSource> {
    equations: &'e Equations<'a, L, S>,
    linear: Matrix,
    situation: Situation<'a>,
    outcome: Outcome,
    /// Matrix with the state it is of: the solver asks for its columns one by one.
    slopes: Option<(f64, Vec<f64>, Matrix)>,
    /// Time, state and rates of the last evaluation.
    last: (f64, Vec<f64>, Vec<f64>),
    tolerance: f64,
    evaluations: usize,
}

impl<L: CreepLaw, S: PatchSource> Shared<'_, '_, L, S> {
    /// Rates at a state; within [`LINEAR_SHARE`] of the tolerance from the state before, by the slopes from there.
    ///
    /// The tables of the contact jump by the rounding of their numbers (1e-7 of a force) at the borders of their cells, one of which is at
    /// the track's centre. An iteration that comes to rest upon one would jump to and fro for ever.
    fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) {
        let (at, of, known) = &self.last;
        if *at == time
            && let Some((.., slopes)) = &self.slopes
            && self.equations.distance(of, state, self.tolerance) < LINEAR_SHARE
        {
            let step: Vec<f64> = state.iter().zip(of).map(|(to, from)| to - from).collect();
            slopes.times(&step, rates);
            for (rate, known) in rates.iter_mut().zip(known) {
                *rate += known;
            }
            return;
        }
        self.evaluate(time, state, rates);
        self.last = (time, state.to_vec(), rates.to_vec());
    }

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
        rates[2 * N * bodies..].copy_from_slice(&outcome.piston_velocities);
    }

    fn slopes_times(&mut self, time: f64, state: &[f64], vector: &[f64], product: &mut [f64]) {
        let is_known = self
            .slopes
            .as_ref()
            .is_some_and(|(at, of, _)| *at == time && of == state);
        if !is_known {
            let matrix = self
                .equations
                .slopes(&self.linear, &mut self.situation, time, state);
            self.slopes = Some((time, state.to_vec(), matrix));
        }
        if let Some((.., matrix)) = &self.slopes {
            matrix.times(vector, product);
        }
    }
}

impl<L: CreepLaw, S: PatchSource> Equations<'_, L, S> {
    /// Magnitude of a state below which the tolerance is absolute.
    fn scale(&self, k: usize) -> f64 {
        let coordinates = N * self.bodies();
        let is_velocity = (coordinates..2 * coordinates).contains(&k);
        SCALES[usize::from(is_velocity)]
    }

    /// Distance of two states over the tolerance: root mean square.
    fn distance(&self, from: &[f64], to: &[f64], tolerance: f64) -> f64 {
        let over = |(k, (from, to)): (usize, (&f64, &f64))| {
            let allowed = tolerance * (from.abs() + self.scale(k));
            ((to - from) / allowed).powi(2)
        };
        let squares: f64 = from.iter().zip(to).enumerate().map(over).sum();
        (squares / self.size() as f64).sqrt()
    }
}

fn problem<'p, L: CreepLaw, S: PatchSource>(
    shared: &'p RefCell<Shared<'_, '_, L, S>>,
    start: &'p [f64],
    tolerance: f64,
) -> Result<
    OdeSolverProblem<
        impl OdeEquationsImplicit<M = Dense, V = Vector, T = f64, C = NalgebraContext> + 'p,
    >,
    DiffsolError,
> {
    let equations = shared.borrow().equations;
    let absolute = (0..equations.size()).map(|k| tolerance * equations.scale(k));
    let roots = 2 * equations.ranged.len();
    OdeBuilder::<Dense>::new()
        .rtol(tolerance)
        .atol(absolute.collect::<Vec<f64>>())
        .h0(FIRST_STEP_S)
        .rhs_implicit(
            move |x: &[f64], _p: &[f64], t: f64, y: &mut [f64]| {
                shared.borrow_mut().rates(t, x, y);
            },
            move |x: &[f64], _p: &[f64], t: f64, v: &[f64], y: &mut [f64]| {
                shared.borrow_mut().slopes_times(t, x, v, y);
            },
        )
        .init(
            move |_p: &[f64], _t: f64, y: &mut [f64]| y.copy_from_slice(start),
            start.len(),
        )
        .root(
            move |x: &[f64], _p: &[f64], t: f64, y: &mut [f64]| {
                let shared = &mut *shared.borrow_mut();
                let margins = shared.equations.margins(&mut shared.situation, t, x);
                // one at least, which is never met
                y.fill(1.0);
                y[..margins.len()].copy_from_slice(&margins);
            },
            roots.max(1),
        )
        .build()
}

/// Runs from `start` at the time 0 and tells `told` of the situation, time and state at each of the rising `times`.
pub(super) fn run<'a, L: CreepLaw, S: PatchSource>(
    equations: &Equations<'a, L, S>,
    situation: Situation<'a>,
    start: &[f64],
    times: &[f64],
    tolerance: f64,
    mut told: impl FnMut(&mut Situation<'a>, f64, &[f64]),
) -> Result<Statistics, ReferenceError> {
    let failed = |place: String| {
        move |source: DiffsolError| ReferenceError::Solver {
            place,
            source: source.into(),
        }
    };
    let shared = RefCell::new(Shared {
        equations,
        linear: equations.linear_slopes(),
        situation,
        outcome: Outcome::default(),
        slopes: None,
        last: (f64::NAN, vec![], vec![]),
        tolerance,
        evaluations: 0,
    });
    let mut problem = problem(&shared, start, tolerance).map_err(failed(String::new()))?;
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    problem.ode_options.min_timestep = 1e-16;
    let mut solver = problem
        .esdirk34::<NalgebraLU<f64>>()
        .map_err(failed(String::new()))?;
    let mut statistics = Statistics::default();
    let mut waiting = times.iter().copied().peekable();
    while let Some(time) = waiting.next_if(|time| *time <= 0.0) {
        told(&mut shared.borrow_mut().situation, time, start);
    }
    let Some(end) = times.last().copied().filter(|end| *end > 0.0) else {
        return Ok(statistics);
    };
    let edges = shared.borrow().situation.path.edges(end);
    let mut state = start.to_vec();
    let mut rates = vec![0.0; start.len()];
    let (mut now, mut step) = (0.0, FIRST_STEP_S);
    for edge in edges.into_iter().chain([end]) {
        if edge < now + LEAST_APART_S {
            continue;
        }
        shared.borrow_mut().situation.enter(0.5 * (now + edge));
        let at = |time: f64| format!(" (at {time} s)");
        // Restarts, until the edge is met.
        loop {
            {
                let shared = &mut *shared.borrow_mut();
                statistics.events += equations.settle(&mut shared.situation, now, &mut state);
                shared.slopes = None;
                shared.rates(now, &state, &mut rates);
            }
            let mut restart = solver.state_clone();
            {
                let restart = restart.as_mut();
                for k in 0..state.len() {
                    restart.y[k] = state[k];
                    restart.dy[k] = rates[k];
                }
                *restart.t = now;
                *restart.h = step;
            }
            solver.set_state(restart);
            solver.set_stop_time(edge).map_err(failed(at(now)))?;
            let is_at_edge = loop {
                let reason = solver.step().map_err(failed(at(now)))?;
                let met = match reason {
                    OdeSolverStopReason::RootFound(time, _) => Some(time),
                    _ => None,
                };
                now = met.unwrap_or(solver.state().t);
                while let Some(time) = waiting.next_if(|time| *time <= now) {
                    let at_time = solver.interpolate(time).map_err(failed(at(time)))?;
                    let at_time: Vec<f64> = (0..state.len()).map(|k| at_time[k]).collect();
                    told(&mut shared.borrow_mut().situation, time, &at_time);
                }
                if let Some(time) = met {
                    let there = solver.interpolate(time).map_err(failed(at(time)))?;
                    (0..state.len()).for_each(|k| state[k] = there[k]);
                    step = solver.state().h;
                    break edge - now < LEAST_APART_S;
                }
                if matches!(reason, OdeSolverStopReason::TstopReached) {
                    let there = solver.state();
                    (0..state.len()).for_each(|k| state[k] = there.y[k]);
                    break true;
                }
                step = solver.state().h;
            };
            if is_at_edge {
                break;
            }
        }
    }
    for time in waiting {
        told(&mut shared.borrow_mut().situation, time, &state);
    }
    let counted = solver.get_statistics();
    statistics.steps = counted.number_of_steps;
    statistics.rejected = counted.number_of_error_test_failures;
    statistics.factorisations = counted.number_of_linear_solver_setups;
    statistics.evaluations = shared.borrow().evaluations;
    Ok(statistics)
}
