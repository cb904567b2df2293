//! Segments by ESDIRK34 of diffsol: adaptive, L-stable, order 4, with its own root finding.

use std::cell::RefCell;
use std::marker::PhantomData;
use std::rc::Rc;

use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquationsImplicit,
    OdeSolverMethod, OdeSolverProblem, OdeSolverState, OdeSolverStopReason, RkState,
};

use super::segment::{Arrival, Integrator, STATES, Segment};
use crate::error::ReferenceError;

/// Tolerance per step, relative and absolute to the scales of a segment.
const TOLERANCE: f64 = 1e-12;

/// First step of the first segment, over its time scale.
const FIRST_STEP: f64 = 1e-3;

type Vector = NalgebraVec<f64>;
type Matrix = NalgebraMat<f64>;

/// The segment the equations refer to.
type Shared = Rc<RefCell<Segment>>;

/// Equations of a segment; each segment is the same problem with other constants.
trait Equations: OdeEquationsImplicit<M = Matrix, V = Vector, T = f64, C = NalgebraContext> {}
impl<E> Equations for E where
    E: OdeEquationsImplicit<M = Matrix, V = Vector, T = f64, C = NalgebraContext>
{
}

fn problem(shared: &Shared) -> Result<OdeSolverProblem<impl Equations>, DiffsolError> {
    let [rates, slopes, events, initial] = std::array::from_fn(|_| Rc::clone(shared));
    OdeBuilder::<Matrix>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE; STATES])
        .h0(FIRST_STEP)
        .rhs_implicit(
            move |x: &[f64], _p: &[f64], _t: f64, y: &mut [f64]| {
                y.copy_from_slice(&rates.borrow().rates(&[x[0], x[1], x[2]]));
            },
            move |x: &[f64], _p: &[f64], _t: f64, v: &[f64], y: &mut [f64]| {
                if v[0] == 0.0 {
                    y.fill(0.0);
                } else {
                    let columns = slopes.borrow().slopes(&[x[0], x[1], x[2]]);
                    for (out, slope) in y.iter_mut().zip(columns) {
                        *out = slope * v[0];
                    }
                }
            },
        )
        .init(
            move |_p: &[f64], _t: f64, y: &mut [f64]| {
                y.copy_from_slice(&initial.borrow().initial());
            },
            STATES,
        )
        .root(
            move |x: &[f64], _p: &[f64], _t: f64, y: &mut [f64]| {
                y.copy_from_slice(&events.borrow().events(&[x[0], x[1], x[2]]));
            },
            2,
        )
        .build()
}

/// Run `work` with an integrator set up on the problem of `first`.
pub(super) fn with_esdirk<R>(
    first: Segment,
    work: impl FnOnce(&mut dyn Integrator) -> Result<R, ReferenceError>,
) -> Result<R, ReferenceError> {
    let in_setup = |source: DiffsolError| ReferenceError::Solver {
        place: String::new(),
        source: source.into(),
    };
    let shared = Rc::new(RefCell::new(first));
    let mut problem = problem(&shared).map_err(in_setup)?;
    // counted over the whole motion, not a step; a run that stalls ends at the least step
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    problem.ode_options.min_timestep = 1e-18;
    let solver = problem.esdirk34::<NalgebraLU<f64>>().map_err(in_setup)?;
    work(&mut Esdirk {
        solver,
        shared: Rc::clone(&shared),
        natural_step: FIRST_STEP,
        equations: PhantomData,
    })
}

/// The solver, used for all segments: setting it up costs more than a short segment.
struct Esdirk<'a, E, S> {
    solver: S,
    shared: Shared,
    /// Step the error control last wanted, not cut by the end of a segment.
    natural_step: f64,
    equations: PhantomData<&'a E>,
}

impl<'a, E, S> Integrator for Esdirk<'a, E, S>
where
    E: Equations + 'a,
    S: OdeSolverMethod<'a, E, State = RkState<Vector>>,
{
    fn advance(&mut self, segment: &Segment) -> Result<Arrival, ReferenceError> {
        let in_solution = |source: DiffsolError| ReferenceError::Solver {
            place: format!(
                " (side {}, seat velocity {} m/s)",
                segment.side, segment.speed
            ),
            source: source.into(),
        };
        self.shared.borrow_mut().clone_from(segment);
        let start = segment.initial();
        let rates = segment.rates(&start);
        let mut state = self.solver.state_clone();
        {
            let state = state.as_mut();
            for i in 0..STATES {
                state.y[i] = start[i];
                state.dy[i] = rates[i];
            }
            *state.t = 0.0;
            *state.h = self.natural_step;
        }
        self.solver.set_state(state);
        loop {
            let reason = self.solver.step().map_err(in_solution)?;
            let state = self.solver.state();
            self.natural_step = state.h;
            match reason {
                OdeSolverStopReason::InternalTimestep => {}
                OdeSolverStopReason::RootFound(clock, which) => {
                    let end = self.solver.interpolate(clock).map_err(in_solution)?;
                    return Ok(Arrival {
                        state: [end[0], end[1], end[2]],
                        at_bound: which == 0,
                    });
                }
                OdeSolverStopReason::TstopReached => {
                    return Err(ReferenceError::NoEvent);
                }
            }
        }
    }

    fn steps(&self) -> usize {
        self.solver.get_statistics().number_of_steps
    }
}
