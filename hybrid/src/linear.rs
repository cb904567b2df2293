//! A linear system in steps of one size.

use nalgebra::{DMatrix, SMatrix, SVector};

/// `x' = A x + B u` with `u` constant during a step, solved exactly by the matrix exponential.
///
/// ```
/// use dashpot_hybrid::LinearSystem;
/// use nalgebra::{Matrix1, Vector1};
///
/// // x' = u - 2 x reaches u/2 (1 - exp(-2 t)).
/// let mut system = LinearSystem::new(&Matrix1::new(-2.0), &Matrix1::new(1.0), 0.1);
/// for _ in 0..10 {
///     system.step(&Vector1::new(1.0));
/// }
/// assert!((system.state[0] - 0.5 * (1.0 - (-2.0_f64).exp())).abs() < 1e-14);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LinearSystem<const N: usize, const M: usize> {
    /// The state `x`.
    pub state: SVector<f64, N>,
    transition: SMatrix<f64, N, N>,
    input: SMatrix<f64, N, M>,
}

impl<const N: usize, const M: usize> LinearSystem<N, M> {
    /// The system at rest, for steps of `step_s`.
    pub fn new(a: &SMatrix<f64, N, N>, b: &SMatrix<f64, N, M>, step_s: f64) -> Self {
        // The exponential of [A B; 0 0] h contains both matrices of the step.
        let mut both = DMatrix::zeros(N + M, N + M);
        both.view_mut((0, 0), (N, N)).copy_from(&(a * step_s));
        both.view_mut((0, N), (N, M)).copy_from(&(b * step_s));
        let both = both.exp();
        Self {
            state: SVector::zeros(),
            transition: both.fixed_view::<N, N>(0, 0).into_owned(),
            input: both.fixed_view::<N, M>(0, N).into_owned(),
        }
    }

    /// Takes a step with the inputs `u`.
    pub fn step(&mut self, u: &SVector<f64, M>) {
        self.state = self.transition * self.state + self.input * u;
    }
}
