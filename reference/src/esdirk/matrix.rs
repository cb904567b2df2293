//! The iteration matrix `I - gamma h J` of simplified Newton, with factors that are kept over several steps.

use super::interface::Equations;
use crate::linear::{Factors, Matrix};

/// Maximum age of the Jacobian and of the factors, in steps.
const JACOBIAN_STEPS: u32 = 50;
const FACTOR_STEPS: u32 = 20;

/// Relative change of the step length since the last factorisation above which the matrix is factorised again.
const MAX_LENGTH_DRIFT: f64 = 0.3;

/// Relative change of the step length below which divergence is attributed to an old Jacobian.
const JACOBIAN_LENGTH_DRIFT: f64 = 0.2;

/// Reason why the iteration matrix may be out of date.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Cause {
    Restart,
    Accepted,
    ErrorTooLarge,
    FirstDivergence,
    FurtherDivergence,
}

/// Jacobian and factors, with their ages.
pub(super) struct IterationMatrix {
    gamma: f64,
    jacobian: Matrix,
    factors: Factors,
    jacobian_age: u32,
    factors_age: u32,
    factored_length: f64,
}

impl IterationMatrix {
    /// Builds a matrix for a number of states; [`Self::update`] sets it.
    pub(super) fn new(gamma: f64, size: usize) -> Self {
        Self {
            gamma,
            jacobian: Matrix::zeros(size),
            factors: Factors::new(Matrix::zeros(size)),
            jacobian_age: 0,
            factors_age: 0,
            factored_length: 0.0,
        }
    }

    /// Replaces the right side by the solution.
    pub(super) fn solve(&self, right_side: &mut [f64]) {
        self.factors.solve(right_side);
    }

    /// Increases both ages by one step.
    pub(super) fn age(&mut self) {
        self.jacobian_age += 1;
        self.factors_age += 1;
    }

    /// Evaluates the Jacobian at a state and factorises the matrix for a step length, if either is due. Returns true if
    /// the factors are new.
    pub(super) fn update(
        &mut self,
        equations: &mut impl Equations,
        (time, state): (f64, &[f64]),
        length: f64,
        cause: Cause,
    ) -> bool {
        let drift = (length / self.factored_length - 1.0).abs();
        let is_jacobian_due = match cause {
            Cause::Restart => true,
            Cause::Accepted => self.jacobian_age >= JACOBIAN_STEPS,
            Cause::FirstDivergence => drift < JACOBIAN_LENGTH_DRIFT,
            Cause::FurtherDivergence => self.jacobian_age > 0,
            Cause::ErrorTooLarge => false,
        };
        let is_due = is_jacobian_due
            || match cause {
                Cause::Restart | Cause::ErrorTooLarge => true,
                Cause::Accepted => self.factors_age >= FACTOR_STEPS || drift > MAX_LENGTH_DRIFT,
                Cause::FirstDivergence | Cause::FurtherDivergence => drift != 0.0,
            };
        if is_jacobian_due {
            equations.jacobian(time, state, &mut self.jacobian);
            self.jacobian_age = 0;
        }
        if !is_due {
            return false;
        }
        let factor = self.gamma * length;
        let jacobian = &self.jacobian;
        self.factors.replace(|matrix| {
            for row in 0..jacobian.size() {
                let entries = matrix.row_mut(row);
                for (entry, slope) in entries.iter_mut().zip(jacobian.row(row)) {
                    *entry = -factor * slope;
                }
                entries[row] += 1.0;
            }
        });
        self.factors_age = 0;
        self.factored_length = length;
        true
    }
}
