//! Factors of the forces, by least squares.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::equations::Block;
use super::error::SensorsError;
use super::layout::Layout;
use super::limits::{MIN_SECONDS, MIN_SPARE_SECONDS};

/// Minimum eigenvalue of the normal equations, each factor scaled to 1.
const MIN_EIGENVALUE: f64 = 1e-8;

/// Factors of the forces between body and bogies, 1 for the nominal vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// Names, as [`Layout::factor_names`].
    pub names: Vec<String>,
    /// Factors (1).
    pub values: Vec<f64>,
    /// Covariance of the factors, from the scatter of the seconds, row by row.
    pub covariance: Vec<Vec<f64>>,
    /// Seconds of ride that were used.
    pub seconds: usize,
    /// Seconds that were left out because the body reached a lateral stop.
    pub seconds_at_stop: usize,
    /// Share of the squared inertia forces that the balance leaves unexplained.
    pub unexplained: f64,
    /// Sensors used.
    pub sensors: Vec<String>,
}

impl Factors {
    /// Solves the normal equations of all seconds: `x = S sum r_i` with `S = (sum N_i)^-1`, and covariance
    /// `S sum(g_i g_i') S B/(B - P)` with `g_i = r_i - N_i x`, of `B` seconds and `P` factors.
    pub(super) fn solve(
        layout: &Layout,
        sensors: Vec<String>,
        blocks: &[Block],
    ) -> Result<Self, SensorsError> {
        let names = layout.factor_names();
        let (factors, at_stop) = (
            names.len(),
            blocks.iter().filter(|block| block.at_stop).count(),
        );
        let used: Vec<&Block> = blocks.iter().filter(|block| !block.at_stop).collect();
        if used.len() < MIN_SECONDS.max(factors + MIN_SPARE_SECONDS) {
            return Err(SensorsError::TooFewSeconds {
                blocks: used.len(),
                factors,
                at_stop,
            });
        }
        let zero = (DMatrix::zeros(factors, factors), DVector::zeros(factors));
        let (matrix, vector) = used.iter().fold(zero, |(matrix, vector), block| {
            (matrix + &block.matrix, vector + &block.vector)
        });
        let inverse = inverse(&matrix).map_err(|factor| SensorsError::Undetermined {
            factor: names[factor].clone(),
        })?;
        let values = &inverse * &vector;
        let mut scatter = DMatrix::zeros(factors, factors);
        for block in &used {
            let rest = &block.vector - &block.matrix * &values;
            scatter.ger(1.0, &rest, &rest, 1.0);
        }
        let count = used.len() as f64;
        let covariance = &inverse * scatter * &inverse * (count / (count - factors as f64));
        let square: f64 = used.iter().map(|block| block.square).sum();
        Ok(Self {
            names,
            covariance: covariance
                .row_iter()
                .map(|row| row.iter().copied().collect())
                .collect(),
            seconds: used.len(),
            seconds_at_stop: at_stop,
            unexplained: 1.0 - values.dot(&vector) / square,
            values: values.iter().copied().collect(),
            sensors,
        })
    }
}

/// Returns the inverse, or the number of the factor that is determined worst.
fn inverse(matrix: &DMatrix<f64>) -> Result<DMatrix<f64>, usize> {
    let scale = matrix.diagonal().map(|square| 1.0 / square.sqrt());
    if let Some(factor) = scale.iter().position(|scale| !scale.is_finite()) {
        return Err(factor);
    }
    let scaling = DMatrix::from_diagonal(&scale);
    let eigen = SymmetricEigen::new(&scaling * matrix * &scaling);
    let least = eigen.eigenvalues.imin();
    if !(MIN_EIGENVALUE..).contains(&eigen.eigenvalues[least]) {
        return Err(eigen.eigenvectors.column(least).iamax());
    }
    let inverse = &eigen.eigenvectors
        * DMatrix::from_diagonal(&eigen.eigenvalues.map(f64::recip))
        * eigen.eigenvectors.transpose();
    Ok(&scaling * inverse * &scaling)
}
