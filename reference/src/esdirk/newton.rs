//! Convergence of the simplified Newton iteration of a stage (Hairer and Wanner, Solving Ordinary Differential
//! Equations II, IV.8).

/// Maximum number of iterations per stage.
pub(super) const MAX_ITERATIONS: i32 = 10;

/// Maximum error of the iteration, relative to the tolerance of a step.
const ERROR_RATIO: f64 = 0.2;

/// Rate of convergence above which an iteration counts as divergent.
const MAX_RATE: f64 = 0.9;

/// Ratio of error to last change that the iteration assumes with new factors, until it knows its rate of convergence.
const NEW_FACTORS: f64 = 20.0;

/// Ratio of error to last change that the iteration assumes with a new step length, until it knows its rate of
/// convergence.
const NEW_LENGTH: f64 = 100.0;

/// Exponent that moves the assumed ratio towards 1 from one stage to the next.
const TRUST: f64 = 0.8;

/// Smallest assumed ratio of error to last change.
const MIN_ERROR_OVER_CHANGE: f64 = 1e4 * f64::EPSILON;

/// Result of one iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    Converged,
    Continue,
    Diverged,
}

/// Judges iterations by the size of their changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Convergence {
    first_change: f64,
    iterations: i32,
    /// Estimated ratio of error to last change, `rate / (1 - rate)`.
    error_over_change: f64,
}

impl Convergence {
    pub(super) fn new() -> Self {
        Self {
            first_change: 0.0,
            iterations: 0,
            error_over_change: NEW_FACTORS.powf(1.0 / TRUST),
        }
    }

    /// Forgets the rates found with old factors.
    pub(super) fn reset_for_factors(&mut self) {
        self.error_over_change = NEW_FACTORS.powf(1.0 / TRUST);
    }

    /// Forgets the rates found with another step length.
    pub(super) fn reset_for_length(&mut self) {
        self.error_over_change = NEW_LENGTH.powf(1.0 / TRUST);
    }

    /// Starts the iteration of a stage.
    pub(super) fn start(&mut self) {
        self.iterations = 0;
    }

    /// Number of iterations of the last stage.
    pub(super) fn iterations(&self) -> i32 {
        self.iterations
    }

    /// Judges an iteration by its change, relative to the tolerance of a step. NaN counts as divergent.
    pub(super) fn judge(&mut self, change: f64) -> Verdict {
        self.iterations += 1;
        if self.iterations == 1 {
            self.first_change = change;
            self.error_over_change = self
                .error_over_change
                .max(MIN_ERROR_OVER_CHANGE)
                .powf(TRUST);
        } else {
            let rate = (change / self.first_change).powf(1.0 / f64::from(self.iterations - 1));
            let left = MAX_ITERATIONS - self.iterations;
            let expected = rate.powi(left) / (1.0 - rate) * change;
            let hopeful = rate <= MAX_RATE && expected <= ERROR_RATIO;
            if !hopeful {
                return Verdict::Diverged;
            }
            self.error_over_change = rate / (1.0 - rate);
        }
        if self.error_over_change * change < ERROR_RATIO {
            Verdict::Converged
        } else if self.iterations == MAX_ITERATIONS || change.is_nan() {
            Verdict::Diverged
        } else {
            Verdict::Continue
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fast_iteration_converges_and_is_trusted_in_the_next_stage() {
        let mut convergence = Convergence::new();
        convergence.start();
        assert_eq!(convergence.judge(1.0), Verdict::Continue);
        assert_eq!(convergence.judge(1e-3), Verdict::Converged);
        convergence.start();
        assert_eq!(convergence.judge(1.0), Verdict::Converged);
        convergence.reset_for_factors();
        convergence.start();
        assert_eq!(convergence.judge(1.0), Verdict::Continue);
    }

    #[test]
    fn slow_growing_and_undefined_iterations_diverge() {
        for changes in [[1e3, 8e2], [1.0, 2.0], [1.0, f64::NAN]] {
            let mut convergence = Convergence::new();
            convergence.start();
            assert_eq!(convergence.judge(changes[0]), Verdict::Continue);
            assert_eq!(
                convergence.judge(changes[1]),
                Verdict::Diverged,
                "{changes:?}"
            );
        }
        assert_eq!(Convergence::new().judge(f64::NAN), Verdict::Diverged);
    }
}
