//! What numbers that nobody measured with the force, such as the temperature of the oil, do to those that are found.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::Serialize;

use super::model::Model;
use super::{Calibration, CalibrationError};
use dashpot_files::damper::range;

/// Uncertainty of the oil's temperature where the user gives none (K), with a probability of 95 %: that of a bench in a hall whose oil warms up.
pub const TEMPERATURE_UNCERTAINTY_K: f64 = 5.0;

/// Key of the oil's temperature.
pub const TEMPERATURE: &str = "oil.temperature_c";

/// Key of the oil's density.
pub const DENSITY: &str = "oil.density_kg_per_m3";

/// A direction whose eigenvalue is below this share of the largest is unknown, and stays where it is.
const LEAST_SHARE: f64 = 1e-6;

/// What an assumed number does to those that are found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// The assumed number.
    pub key: String,
    /// Its value in the damper.
    pub value: f64,
    /// Half of its interval of 95 %.
    pub uncertainty: f64,
    /// How far each found number moves with the assumed one at the lower and at the upper end of its interval.
    pub shifts: Vec<[f64; 2]>,
    /// By how much the sum of squares changes there.
    pub chi_square: [f64; 2],
}

impl Influence {
    /// How far the found number `number` moves, the larger of both ends.
    pub fn shift(&self, number: usize) -> f64 {
        self.shifts[number]
            .map(f64::abs)
            .into_iter()
            .fold(0.0, f64::max)
    }
}

impl Calibration {
    /// The assumed numbers and their uncertainties.
    fn assumed(&self) -> Vec<(&'static str, f64)> {
        let both = [
            (TEMPERATURE, self.assumed.temperature_uncertainty_k),
            (DENSITY, self.assumed.density_uncertainty_kg_per_m3),
        ];
        let is_assumed = |key: &str| self.varied.iter().all(|varied| varied.key != key);
        both.into_iter()
            .filter(|(key, uncertainty)| *uncertainty > 0.0 && is_assumed(key))
            .collect()
    }

    /// What the assumed numbers of this damper do to those found at `places`: the squares' least point moves by one step of Gauss and Newton from
    /// the forces at the end of the assumed number's interval.
    ///
    /// # Errors
    /// As [`Model::deviations`].
    pub(super) fn influences(
        &self,
        model: &Model<'_>,
        places: &[f64],
    ) -> Result<Vec<Influence>, CalibrationError> {
        let assumed = self.assumed();
        let known = assumed.into_iter().filter_map(|(key, uncertainty)| {
            Some((key, self.damper.number(key).ok()?, uncertainty))
        });
        let known: Vec<_> = known.collect();
        if known.is_empty() {
            return Ok(Vec::new());
        }
        let step = Step::new(model, places)?;
        let of = |(key, value, uncertainty): (&str, f64, f64)| {
            let [low, high] = [-uncertainty, uncertainty].map(|by| {
                let [least, greatest] =
                    range(key).map_or([value; 2], |range| [range.min, range.max]);
                step.to(key, (value + by).clamp(least, greatest))
            });
            let (low, high) = (low?, high?);
            let shifts = low.0.into_iter().zip(high.0).map(|(low, high)| [low, high]);
            Ok(Influence {
                key: key.into(),
                value,
                uncertainty,
                shifts: shifts.collect(),
                chi_square: [low.1, high.1],
            })
        };
        known.into_iter().map(of).collect()
    }
}

/// A step from the least squares at some places to those of a damper that differs in an assumed number.
struct Step<'a, 'm> {
    model: &'a Model<'m>,
    places: &'a [f64],
    /// The slopes of the deviations, in units of what is tolerated.
    slopes: DMatrix<f64>,
    tolerances: Vec<f64>,
    eigen: SymmetricEigen<f64, nalgebra::Dyn>,
    /// The sum of squares of the tests here.
    chi_square: f64,
}

impl<'a, 'm> Step<'a, 'm> {
    fn new(model: &'a Model<'m>, places: &'a [f64]) -> Result<Self, CalibrationError> {
        let all: Vec<usize> = (0..model.varied.len()).collect();
        let values = model.values(places);
        let numbers = model.varied.iter().zip(&values);
        let tolerances: Vec<f64> = numbers
            .map(|(varied, value)| varied.tolerance(*value))
            .collect();
        let mut slopes = model.slopes(places, &all)?;
        for (column, tolerance) in tolerances.iter().enumerate() {
            slopes.column_mut(column).scale_mut(*tolerance);
        }
        let mut curvature = slopes.transpose() * &slopes;
        for (number, _, slope) in model.off_priors(places) {
            curvature[(number, number)] += (slope * tolerances[number]).powi(2);
        }
        let here = model.deviations(places)?;
        Ok(Self {
            model,
            places,
            slopes,
            tolerances,
            eigen: SymmetricEigen::new(curvature),
            chi_square: here.iter().map(|deviation| deviation * deviation).sum(),
        })
    }

    /// How far the numbers move when the damper's number at `key` is `value`, and by how much the sum of squares changes.
    fn to(&self, key: &str, value: f64) -> Result<(Vec<f64>, f64), CalibrationError> {
        let damper = self.model.damper_with(self.places, &[(key, value)])?;
        let there = DVector::from_vec(self.model.deviations_of(&damper, self.places)?);
        let chi_square = there.norm_squared();
        let mut gradient = self.slopes.transpose() * there;
        for (number, deviation, slope) in self.model.off_priors(self.places) {
            gradient[number] += deviation * slope * self.tolerances[number];
        }
        let least = LEAST_SHARE * self.eigen.eigenvalues.max();
        let vectors = &self.eigen.eigenvectors;
        let along = vectors.transpose() * &gradient;
        let solved = along.zip_map(&self.eigen.eigenvalues, |part, value| {
            if value > least { -part / value } else { 0.0 }
        });
        let gain: f64 = -along.dot(&solved);
        let step = vectors * solved;
        let moved = self.model.varied.iter().zip(self.places).enumerate();
        let moved = moved.map(|(number, (varied, place))| {
            let to = (place + step[number] * self.tolerances[number]).clamp(0.0, 1.0);
            varied.at(to) - varied.at(*place)
        });
        Ok((moved.collect(), chi_square - gain - self.chi_square))
    }
}

/// An interval that holds the noise's and the assumed numbers' parts, which are independent: their distances add as squares.
pub(super) fn widened(
    found: f64,
    [least, greatest]: [Option<f64>; 2],
    shifts: impl Iterator<Item = [f64; 2]> + Clone,
) -> [Option<f64>; 2] {
    let square = |of: &dyn Fn(f64) -> f64| -> f64 {
        let parts = shifts.clone();
        parts
            .map(|shift| shift.map(of).into_iter().fold(0.0, f64::max).powi(2))
            .sum()
    };
    let (below, above) = (square(&|shift| -shift), square(&|shift| shift));
    [
        least.map(|least| found - ((found - least).powi(2) + below).sqrt()),
        greatest.map(|greatest| found + ((greatest - found).powi(2) + above).sqrt()),
    ]
}
