//! Adaptive solver of stiff differential equations `dx/dt = f(t, x)` with events: ESDIRK methods of order 3 or 5 with
//! simplified Newton iterations, cubic Hermite interpolation and located events.
//!
//! A step is accepted if the root mean square of its error estimate, divided by the tolerances, is below 1. The
//! iteration matrix filters the estimate, so that stiff components do not dominate it (Shampine 1984).

mod crossing;
mod dense;
mod interface;
mod matrix;
mod newton;
mod predictor;
mod refinement;
mod tableau;

use self::crossing::Bracket;
pub(crate) use self::interface::{Counts, Equations, StepEnd, StepTooSmall, Tolerances};
use self::matrix::{Cause, IterationMatrix};
use self::newton::{Convergence, MAX_ITERATIONS, Verdict};
use self::predictor::Predictor;
use self::tableau::Tableau;
pub(crate) use self::tableau::{ESDIRK3, ESDIRK5};

/// Safety factor of a new step length.
const SAFETY: f64 = 0.9;

/// Smallest and largest factor by which the step length changes after a step.
const LENGTH_CHANGE: [f64; 2] = [0.5, 2.0];

/// The step length stays the same if its proposed change is in this range, so that the matrix factors stay valid.
const UNCHANGED: [f64; 2] = [0.9, 2.0];

/// Factor by which the step length changes if an iteration diverges with a new Jacobian.
const CHANGE_AFTER_DIVERGENCE: f64 = 0.3;

/// Fraction by which a step may be lengthened to reach a stop time, so that no tiny step remains.
const APPENDED: f64 = 1e-3;

/// Starting values of the stages' iterations.
#[derive(Clone, Copy)]
enum Guess {
    /// Predicted from the earlier stages.
    EarlierStages,
    /// The last increments times the ratio of the step lengths.
    Last { scale: f64 },
}

/// Solver with the state at the end of its last step and the stages of that step.
pub(crate) struct Esdirk {
    tableau: &'static Tableau,
    predictor: Predictor,
    tolerances: Tolerances,
    time: f64,
    state: Vec<f64>,
    rates: Vec<f64>,
    /// Length that the error control proposes for the next step.
    wanted: f64,
    start_time: f64,
    start: Vec<f64>,
    /// Derivatives at the stages, times the step length; the first and last stages are at the ends of the step.
    increments: Vec<Vec<f64>>,
    known: Vec<f64>,
    stage: Vec<f64>,
    residual: Vec<f64>,
    bracket: Bracket,
    interpolated: Vec<f64>,
    matrix: IterationMatrix,
    convergence: Convergence,
    counts: Counts,
}

impl Esdirk {
    /// Builds a solver with one state per absolute tolerance. Call [`Self::restart`] before the first step.
    pub(crate) fn new(tableau: &'static Tableau, tolerances: Tolerances, events: usize) -> Self {
        let size = tolerances.absolute.len();
        let zeros = || vec![0.0; size];
        Self {
            tableau,
            predictor: Predictor::new(tableau.times, tableau.predicting),
            tolerances,
            time: 0.0,
            state: zeros(),
            rates: zeros(),
            wanted: 0.0,
            start_time: 0.0,
            start: zeros(),
            increments: vec![zeros(); tableau.stages()],
            known: zeros(),
            stage: zeros(),
            residual: zeros(),
            bracket: Bracket::new(events),
            interpolated: zeros(),
            matrix: IterationMatrix::new(tableau.gamma, size),
            convergence: Convergence::new(),
            counts: Counts::default(),
        }
    }

    /// Time at the end of the last step.
    pub(crate) fn time(&self) -> f64 {
        self.time
    }

    /// State at the end of the last step.
    pub(crate) fn state(&self) -> &[f64] {
        &self.state
    }

    /// Length that the error control proposes for the next step, before a stop time shortens it.
    pub(crate) fn wanted_length(&self) -> f64 {
        self.wanted
    }

    pub(crate) fn counts(&self) -> Counts {
        self.counts
    }

    /// Starts at a state, with a first step of at most `length`.
    pub(crate) fn restart(
        &mut self,
        equations: &mut impl Equations,
        time: f64,
        state: &[f64],
        length: f64,
    ) {
        self.time = time;
        self.state.copy_from_slice(state);
        self.wanted = length;
        equations.rates(time, &self.state, &mut self.rates);
        equations.events(time, &self.state, &mut self.bracket.low);
        self.update_matrix(equations, length, Cause::Restart);
    }

    /// Takes one step, which ends at `stop_time` at the latest. After an event, continue with [`Self::restart`].
    pub(crate) fn step(
        &mut self,
        equations: &mut impl Equations,
        stop_time: f64,
    ) -> Result<StepEnd, StepTooSmall> {
        let left = stop_time - self.time;
        let mut length = self.wanted;
        let mut to_stop = length * (1.0 + APPENDED) >= left;
        if to_stop {
            length = left;
        }
        let is_shortened = length < self.wanted;
        let mut has_diverged = false;
        let change = loop {
            if !(length >= self.tolerances.min_length || to_stop) {
                return Err(StepTooSmall {
                    length,
                    time: self.time,
                    min_length: self.tolerances.min_length,
                });
            }
            if !self.solve_stages(equations, length, Guess::EarlierStages) {
                if has_diverged {
                    length *= CHANGE_AFTER_DIVERGENCE;
                    to_stop = false;
                    self.convergence.reset_for_length();
                    self.update_matrix(equations, length, Cause::FurtherDivergence);
                } else {
                    has_diverged = true;
                    self.update_matrix(equations, length, Cause::FirstDivergence);
                }
                continue;
            }
            let error = self.error();
            let change = self.change(error);
            if error < 1.0 {
                break change;
            }
            length *= change;
            to_stop = false;
            self.counts.rejected += 1;
            self.convergence.reset_for_length();
            self.update_matrix(equations, length, Cause::ErrorTooLarge);
        };
        self.accept(length, change, is_shortened);
        if to_stop {
            self.time = stop_time;
        }
        self.update_matrix(equations, self.wanted, Cause::Accepted);
        self.matrix.age();
        Ok(match self.event(equations) {
            Some(event) => event,
            None if to_stop => StepEnd::Stop,
            None => StepEnd::Free,
        })
    }

    /// Solves all stages; false if an iteration diverges.
    fn solve_stages(&mut self, equations: &mut impl Equations, length: f64, guess: Guess) -> bool {
        for (increment, rate) in self.increments[0].iter_mut().zip(&self.rates) {
            *increment = length * rate;
        }
        (1..self.tableau.stages()).all(|stage| {
            let mut increment = std::mem::take(&mut self.increments[stage]);
            match guess {
                Guess::EarlierStages => {
                    let earlier = &self.increments[..stage];
                    self.predictor.predict(earlier, &mut increment);
                }
                Guess::Last { scale } => increment.iter_mut().for_each(|x| *x *= scale),
            }
            let converged = self.solve_stage(equations, length, stage, &mut increment);
            self.increments[stage] = increment;
            converged
        })
    }

    /// Solves `k = h f(known + gamma k)` for one stage; false if the iteration diverges.
    fn solve_stage(
        &mut self,
        equations: &mut impl Equations,
        length: f64,
        stage: usize,
        increment: &mut [f64],
    ) -> bool {
        self.known.copy_from_slice(&self.state);
        for (earlier, coefficient) in self.increments.iter().zip(self.tableau.coefficients[stage]) {
            add_multiple(&mut self.known, *coefficient, earlier);
        }
        let time = self.time + self.tableau.times[stage] * length;
        let gamma = self.tableau.gamma;
        self.convergence.start();
        loop {
            self.stage.copy_from_slice(&self.known);
            add_multiple(&mut self.stage, gamma, increment);
            equations.rates(time, &self.stage, &mut self.residual);
            for (residual, increment) in self.residual.iter_mut().zip(increment.iter()) {
                *residual = increment - length * *residual;
            }
            self.matrix.solve(&mut self.residual);
            for (increment, change) in increment.iter_mut().zip(&self.residual) {
                *increment -= change;
            }
            let change = self
                .tolerances
                .mean_square(&self.residual, &self.state)
                .sqrt();
            match self.convergence.judge(change) {
                Verdict::Converged => break,
                Verdict::Diverged => return false,
                Verdict::Continue => {}
            }
        }
        self.stage.copy_from_slice(&self.known);
        add_multiple(&mut self.stage, gamma, increment);
        true
    }

    /// Mean square of the estimated error, divided by the tolerances.
    fn error(&mut self) -> f64 {
        self.residual.fill(0.0);
        for (increment, weight) in self.increments.iter().zip(self.tableau.error_weights) {
            add_multiple(&mut self.residual, *weight, increment);
        }
        self.matrix.solve(&mut self.residual);
        self.tolerances.mean_square(&self.residual, &self.state)
    }

    /// Factor by which the step length changes after a step with this mean square error; smaller after many iterations.
    fn change(&self, error: f64) -> f64 {
        let (max, used) = (
            f64::from(MAX_ITERATIONS),
            f64::from(self.convergence.iterations()),
        );
        let safety = SAFETY * (2.0 * max + 1.0) / (2.0 * max + used);
        let change = safety * error.powf(-0.5 / f64::from(self.tableau.error_order));
        let [smallest, largest] = LENGTH_CHANGE;
        if change > UNCHANGED[0] && change < UNCHANGED[1] {
            1.0
        } else if change.is_nan() {
            smallest
        } else {
            change.clamp(smallest, largest)
        }
    }

    /// Completes an accepted step, which ends at the last stage.
    fn accept(&mut self, length: f64, change: f64, is_shortened: bool) {
        self.start_time = self.time;
        self.time += length;
        std::mem::swap(&mut self.start, &mut self.state);
        self.state.copy_from_slice(&self.stage);
        let last = self.increments.last().into_iter().flatten();
        for (rate, increment) in self.rates.iter_mut().zip(last) {
            *rate = increment / length;
        }
        let before = self.wanted;
        self.wanted = length * change;
        if is_shortened && change >= 1.0 {
            self.wanted = self.wanted.max(before);
        }
        if self.wanted != length {
            self.convergence.reset_for_length();
        }
        self.counts.steps += 1;
    }

    /// Updates the iteration matrix if an update is due.
    fn update_matrix(&mut self, equations: &mut impl Equations, length: f64, cause: Cause) {
        let at = (self.time, self.state.as_slice());
        if self.matrix.update(equations, at, length, cause) {
            self.convergence.reset_for_factors();
            self.counts.factorisations += 1;
        }
    }
}

fn add_multiple(sum: &mut [f64], factor: f64, vector: &[f64]) {
    for (sum, x) in sum.iter_mut().zip(vector) {
        *sum += factor * x;
    }
}

#[cfg(test)]
mod tests;
