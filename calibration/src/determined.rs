//! How well the tests determine each parameter, from the singular values of the sensitivities.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::CalibrationError;
use super::determination::{Determination, Determined};
use super::model::Model;

/// A direction counts as known if its singular value is at least this share of the largest. The derivatives are finite
/// differences and no more accurate than this.
const MIN_SINGULAR_SHARE: f64 = 1e-3;

/// Number of stretches into which a loop is divided. The errors of different stretches count as independent.
const STRETCHES: usize = 40;

/// Information assumed for an unknown direction, as a share of the minimum information of a known one.
const UNKNOWN: f64 = 1e-12;

/// A parameter belongs to a direction if its component there exceeds this.
const MIN_COMPONENT: f64 = 0.3;

/// Correlation above which two parameters are reported.
pub const HIGH_CORRELATION: f64 = 0.9;

impl Model<'_> {
    /// Evaluates how well the tests determine the parameters at `coordinates`.
    ///
    /// # Errors
    /// Same errors as [`Model::deviations`].
    pub(super) fn determination(
        &self,
        coordinates: &[f64],
    ) -> Result<Determination, CalibrationError> {
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let values = self.values(coordinates);
        let tolerances: Vec<f64> = self
            .varied
            .iter()
            .zip(&values)
            .map(|(varied, value)| varied.tolerance(*value))
            .collect();
        let mut slopes = self.slopes(coordinates, &all)?;
        for (column, tolerance) in tolerances.iter().enumerate() {
            slopes.column_mut(column).scale_mut(*tolerance);
        }
        // The slopes apply to a change by one tolerance, so a singular value below 1 means an undetermined direction.
        let tests = slopes.transpose() * &slopes;
        let mut with_priors = tests.clone();
        for prior in self.prior_terms(coordinates) {
            let index = prior.parameter;
            with_priors[(index, index)] += (prior.slope * tolerances[index]).powi(2);
        }
        let gradients = self.squared_gradients(&slopes, &self.deviations(coordinates)?);
        let by_tests = Scatter::new(tests.clone());
        let priors = &with_priors - &tests;
        let by_all = Scatter::new(with_priors);
        let covariance = by_all.covariance();
        // Sandwich covariance of estimates with wrong weights (Huber 1967).
        let robust = &covariance * (gradients + priors) * &covariance;
        let parameters = all.iter().map(|&parameter| {
            let plain = covariance[(parameter, parameter)];
            let inflation = (robust[(parameter, parameter)] / plain).max(1.0);
            let in_tolerances = by_all.deviations[parameter] * inflation.sqrt();
            let unit = tolerances[parameter] * self.varied[parameter].slope(values[parameter]);
            Determined {
                standard_deviation: in_tolerances * unit,
                inflation,
                has_effect: tests[(parameter, parameter)] > 1.0,
                confounded_with: by_tests
                    .partners(parameter)
                    .map(|partner| self.varied[partner].key.clone())
                    .collect(),
            }
        });
        Ok(Determination {
            parameters: parameters.collect(),
            correlation: by_all.correlation(),
        })
    }
}

impl Model<'_> {
    /// Returns the sum of squared gradients over all stretches of the loops; each index of an index test counts as one
    /// stretch.
    fn squared_gradients(&self, slopes: &DMatrix<f64>, deviations: &[f64]) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(slopes.ncols(), slopes.ncols());
        let mut add = |rows: std::ops::Range<usize>| {
            let gradient = slopes.rows(rows.start, rows.len()).transpose()
                * DVector::from_column_slice(&deviations[rows]);
            sum += &gradient * gradient.transpose();
        };
        let mut row = 0;
        for test in &self.loops {
            let end = row + test.counted.len();
            let length = test.counted.len().div_ceil(STRETCHES).max(1);
            while row < end {
                add(row..(row + length).min(end));
                row = (row + length).min(end);
            }
        }
        (row..deviations.len()).for_each(|index| add(index..index + 1));
        sum
    }
}

/// Inverse of an information matrix, computed from its eigenvalues, which are the squares of the singular values.
struct Scatter {
    eigen: SymmetricEigen<f64, nalgebra::Dyn>,
    deviations: Vec<f64>,
}

impl Scatter {
    fn new(information: DMatrix<f64>) -> Self {
        let count = information.nrows();
        let mut eigen = SymmetricEigen::new(information);
        let min = MIN_SINGULAR_SHARE.powi(2) * eigen.eigenvalues.max();
        for value in eigen.eigenvalues.iter_mut() {
            *value = if *value < min { UNKNOWN * min } else { *value };
        }
        let deviation = |parameter: usize| {
            let terms = eigen.eigenvalues.iter().enumerate().map(|(index, value)| {
                let part = eigen.eigenvectors[(parameter, index)];
                // A direction that does not change the parameter adds nothing to its variance, even if it is unknown.
                if part.abs() < 1e-9 {
                    0.0
                } else {
                    part * part / value
                }
            });
            terms.sum::<f64>().sqrt()
        };
        Self {
            deviations: (0..count).map(deviation).collect(),
            eigen,
        }
    }

    /// Returns the other parameters in the direction that contributes most to the variance of `parameter`.
    fn partners(&self, parameter: usize) -> impl Iterator<Item = usize> {
        let worst = (0..self.deviations.len()).max_by(|a, b| {
            let share = |index: &usize| {
                let part = self.eigen.eigenvectors[(parameter, *index)];
                part * part / self.eigen.eigenvalues[*index]
            };
            share(a).total_cmp(&share(b))
        });
        let in_direction = move |direction: usize| {
            (0..self.deviations.len()).filter(move |partner| {
                *partner != parameter
                    && self.eigen.eigenvectors[(*partner, direction)].abs() > MIN_COMPONENT
            })
        };
        worst.into_iter().flat_map(in_direction)
    }

    fn covariance(&self) -> DMatrix<f64> {
        let inverse = self.eigen.eigenvalues.map(|value| 1.0 / value);
        let vectors = &self.eigen.eigenvectors;
        vectors * DMatrix::from_diagonal(&inverse) * vectors.transpose()
    }

    fn correlation(&self) -> Vec<Vec<f64>> {
        let count = self.deviations.len();
        let covariance = self.covariance();
        let row = |a: usize| {
            let correlation =
                |b: usize| covariance[(a, b)] / (covariance[(a, a)] * covariance[(b, b)]).sqrt();
            (0..count).map(correlation).collect()
        };
        (0..count).map(row).collect()
    }
}
