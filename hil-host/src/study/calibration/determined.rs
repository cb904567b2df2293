//! Which numbers the tests determine, by the singular values of what the forces change by.

use nalgebra::{DMatrix, SymmetricEigen};
use serde::Serialize;

use super::CalibrationError;
use super::model::Model;

/// A direction whose singular value is below this share of the largest is not known: derivatives come from differences.
const LEAST_SHARE: f64 = 1e-3;

/// What such a direction counts as, of the least that is known: hardly anything.
const UNKNOWN: f64 = 1e-12;

/// Share of a direction that makes a number part of it.
const PART: f64 = 0.3;

/// Correlation that is told.
pub const CLOSE: f64 = 0.9;

/// How well the tests determine a number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Determined {
    /// Standard deviation, in the number's unit, by linear theory.
    pub standard_deviation: f64,
    /// Whether it changes any force beyond what these scatter by.
    pub is_felt: bool,
    /// Keys of the numbers that could make up for it.
    pub together_with: Vec<String>,
}

/// Of all numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Determination {
    /// In the order of the numbers.
    pub numbers: Vec<Determined>,
    /// Correlation of each with each, priors included.
    pub correlation: Vec<Vec<f64>>,
}

impl Model {
    /// What the tests determine at `places`.
    ///
    /// # Errors
    /// As [`Model::deviations`].
    pub(super) fn determination(&self, places: &[f64]) -> Result<Determination, CalibrationError> {
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let values = self.values(places);
        let tolerances: Vec<f64> = self
            .varied
            .iter()
            .zip(&values)
            .map(|(varied, value)| varied.tolerance(*value))
            .collect();
        let mut slopes = self.slopes(places, &all)?;
        for (column, tolerance) in tolerances.iter().enumerate() {
            slopes.column_mut(column).scale_mut(*tolerance);
        }
        // In units of what is tolerated, so that one singular value below 1 is a direction not determined.
        let tests = slopes.transpose() * &slopes;
        let mut with_priors = tests.clone();
        for (number, _, slope) in self.off_priors(places) {
            with_priors[(number, number)] += (slope * tolerances[number]).powi(2);
        }
        let by_tests = Scatter::new(tests.clone());
        let by_all = Scatter::new(with_priors);
        let numbers = all.iter().map(|&number| {
            let in_tolerances = by_all.deviations[number];
            let unit = tolerances[number] * self.varied[number].slope(values[number]);
            Determined {
                standard_deviation: in_tolerances * unit,
                is_felt: tests[(number, number)] > 1.0,
                together_with: by_tests
                    .partners(number)
                    .map(|partner| self.varied[partner].key.clone())
                    .collect(),
            }
        });
        Ok(Determination {
            numbers: numbers.collect(),
            correlation: by_all.correlation(),
        })
    }
}

/// The inverse of an information matrix, by its eigenvalues: those of the singular values' squares.
struct Scatter {
    eigen: SymmetricEigen<f64, nalgebra::Dyn>,
    deviations: Vec<f64>,
}

impl Scatter {
    fn new(information: DMatrix<f64>) -> Self {
        let count = information.nrows();
        let mut eigen = SymmetricEigen::new(information);
        let least = LEAST_SHARE.powi(2) * eigen.eigenvalues.max();
        for value in eigen.eigenvalues.iter_mut() {
            *value = if *value < least {
                UNKNOWN * least
            } else {
                *value
            };
        }
        let deviation = |number: usize| {
            let terms = eigen.eigenvalues.iter().enumerate().map(|(index, value)| {
                let part = eigen.eigenvectors[(number, index)];
                // A direction that is not in the number adds nothing, however little is known of it.
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

    /// The numbers that are with `number` in the direction that it is least determined by.
    fn partners(&self, number: usize) -> impl Iterator<Item = usize> {
        let worst = (0..self.deviations.len()).max_by(|a, b| {
            let share = |index: &usize| {
                let part = self.eigen.eigenvectors[(number, *index)];
                part * part / self.eigen.eigenvalues[*index]
            };
            share(a).total_cmp(&share(b))
        });
        let of_direction = move |direction: usize| {
            (0..self.deviations.len()).filter(move |partner| {
                *partner != number && self.eigen.eigenvectors[(*partner, direction)].abs() > PART
            })
        };
        worst.into_iter().flat_map(of_direction)
    }

    fn correlation(&self) -> Vec<Vec<f64>> {
        let count = self.deviations.len();
        let covariance = |a: usize, b: usize| {
            let terms = self.eigen.eigenvalues.iter().enumerate();
            let terms = terms.map(|(index, value)| {
                let vectors = &self.eigen.eigenvectors;
                vectors[(a, index)] * vectors[(b, index)] / value
            });
            terms.sum::<f64>()
        };
        let row = |a: usize| {
            let of = |b: usize| covariance(a, b) / (covariance(a, a) * covariance(b, b)).sqrt();
            (0..count).map(of).collect()
        };
        (0..count).map(row).collect()
    }
}
