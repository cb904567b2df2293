//! Which numbers the tests determine, by the singular values of what the forces change by.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::Serialize;

use super::CalibrationError;
use super::model::Model;

/// A direction whose singular value is below this share of the largest is not known: derivatives come from differences.
const LEAST_SHARE: f64 = 1e-3;

/// Stretches of a loop whose errors count as independent of each other.
const STRETCHES: usize = 40;

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
    /// By what its variance is greater than that of independent samples of equal scatter, at least 1: from what whole stretches of the tests pull it
    /// by, for errors of the displacement act where the force changes fast and last as long as that.
    pub inflation: f64,
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

impl Model<'_> {
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
        let pulls = self.pulls(&slopes, &self.deviations(places)?);
        let by_tests = Scatter::new(tests.clone());
        let priors = &with_priors - &tests;
        let by_all = Scatter::new(with_priors);
        let covariance = by_all.covariance();
        // Of estimates by wrong weights (Huber 1967).
        let robust = &covariance * (pulls + priors) * &covariance;
        let numbers = all.iter().map(|&number| {
            let plain = covariance[(number, number)];
            let inflation = (robust[(number, number)] / plain).max(1.0);
            let in_tolerances = by_all.deviations[number] * inflation.sqrt();
            let unit = tolerances[number] * self.varied[number].slope(values[number]);
            Determined {
                standard_deviation: in_tolerances * unit,
                inflation,
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

impl Model<'_> {
    /// Sum over stretches of the loops of what each pulls the numbers by, squared; each index is a stretch.
    fn pulls(&self, slopes: &DMatrix<f64>, deviations: &[f64]) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(slopes.ncols(), slopes.ncols());
        let mut add = |rows: std::ops::Range<usize>| {
            let pull = slopes.rows(rows.start, rows.len()).transpose()
                * DVector::from_column_slice(&deviations[rows]);
            sum += &pull * pull.transpose();
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

    fn covariance(&self) -> DMatrix<f64> {
        let inverse = self.eigen.eigenvalues.map(|value| 1.0 / value);
        let vectors = &self.eigen.eigenvectors;
        vectors * DMatrix::from_diagonal(&inverse) * vectors.transpose()
    }

    fn correlation(&self) -> Vec<Vec<f64>> {
        let count = self.deviations.len();
        let covariance = self.covariance();
        let row = |a: usize| {
            let of =
                |b: usize| covariance[(a, b)] / (covariance[(a, a)] * covariance[(b, b)]).sqrt();
            (0..count).map(of).collect()
        };
        (0..count).map(row).collect()
    }
}
