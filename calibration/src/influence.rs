//! Effect of assumed parameters, such as an oil temperature that was not measured, on the calibrated ones.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use serde::Serialize;

use super::keys::TEMPERATURE;
use super::model::Model;
use super::{Calibration, CalibrationError};
use dashpot_files::damper::range;

/// Default uncertainty of the oil temperature (K), as the half-width of the 95 % interval: for an indoor bench whose
/// oil warms up.
pub const TEMPERATURE_UNCERTAINTY_K: f64 = 5.0;

/// Key of the oil density.
pub const DENSITY: &str = "oil.density_kg_per_m3";

/// A direction counts as known if its eigenvalue is at least this share of the largest. The step does not move along
/// unknown directions.
const MIN_EIGENVALUE_SHARE: f64 = 1e-6;

/// Effect of an assumed parameter on the calibrated ones.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Influence {
    /// Key of the assumed parameter.
    pub key: String,
    /// Value of the assumed parameter in the damper.
    pub value: f64,
    /// Half-width of the assumed parameter's 95 % interval.
    pub uncertainty: f64,
    /// Shift of each calibrated parameter if the assumed one is at the lower and at the upper end of its interval.
    pub shifts: Vec<[f64; 2]>,
    /// Change of the sum of squares at the lower and at the upper end of the interval.
    pub chi_square: [f64; 2],
}

impl Influence {
    /// Returns the larger of the two shifts of a calibrated parameter, as a magnitude.
    pub fn shift(&self, parameter: usize) -> f64 {
        self.shifts[parameter]
            .map(f64::abs)
            .into_iter()
            .fold(0.0, f64::max)
    }
}

impl Calibration {
    /// Returns the keys of the assumed parameters and their uncertainties.
    fn assumed(&self) -> Vec<(&'static str, f64)> {
        let both = [
            (TEMPERATURE, self.assumed.temperature_uncertainty_k),
            (DENSITY, self.assumed.density_uncertainty_kg_per_m3),
        ];
        let is_assumed = |key: &str| self.varied.iter().all(|varied| varied.base() != key);
        both.into_iter()
            .filter(|(key, uncertainty)| *uncertainty > 0.0 && is_assumed(key))
            .collect()
    }

    /// Returns the mean of the recordings' own oil temperatures; `None` for another key, or if a recording has none.
    fn mean_temperature_c(&self, key: &str) -> Option<f64> {
        let temperatures = self.loops.iter().map(|test| test.temperature_c);
        let temperatures: Vec<f64> = temperatures.collect::<Option<_>>()?;
        let count = temperatures.len();
        (key == TEMPERATURE && count > 0).then(|| temperatures.iter().sum::<f64>() / count as f64)
    }

    /// Computes the effect of the assumed parameters on the parameters calibrated at `coordinates`.
    ///
    /// For each end of an assumed parameter's interval, one Gauss-Newton step gives the shift of the minimum.
    ///
    /// # Errors
    /// Same errors as [`Model::deviations`].
    pub(super) fn influences(
        &self,
        model: &Model<'_>,
        coordinates: &[f64],
    ) -> Result<Vec<Influence>, CalibrationError> {
        let assumed = self.assumed();
        let known = assumed.into_iter().filter_map(|(key, uncertainty)| {
            Some((key, self.damper.number(key).ok()?, uncertainty))
        });
        let known: Vec<_> = known.collect();
        if known.is_empty() {
            return Ok(Vec::new());
        }
        let step = Step::new(model, coordinates)?;
        let influence = |(key, value, uncertainty): (&str, f64, f64)| {
            let [low, high] = [-uncertainty, uncertainty].map(|by| {
                let [min, max] = range(key).map_or([value; 2], |range| [range.min, range.max]);
                step.to(key, (value + by).clamp(min, max))
            });
            let (low, high) = (low?, high?);
            let shifts = low
                .shifts
                .into_iter()
                .zip(high.shifts)
                .map(|(low, high)| [low, high]);
            Ok(Influence {
                key: key.into(),
                value: self.mean_temperature_c(key).unwrap_or(value),
                uncertainty,
                shifts: shifts.collect(),
                chi_square: [low.chi_square, high.chi_square],
            })
        };
        known.into_iter().map(influence).collect()
    }
}

/// Result of a change of an assumed parameter.
struct Moved {
    /// Shift of each calibrated parameter.
    shifts: Vec<f64>,
    /// Change of the sum of squares.
    chi_square: f64,
}

/// Gauss-Newton step from the minimum to the new minimum after a change of an assumed parameter.
struct Step<'a, 'm> {
    model: &'a Model<'m>,
    coordinates: &'a [f64],
    /// Derivatives of the deviations, in units of the tolerances.
    slopes: DMatrix<f64>,
    tolerances: Vec<f64>,
    eigen: SymmetricEigen<f64, nalgebra::Dyn>,
    /// Sum of squares of the tests at the minimum.
    chi_square: f64,
}

impl<'a, 'm> Step<'a, 'm> {
    fn new(model: &'a Model<'m>, coordinates: &'a [f64]) -> Result<Self, CalibrationError> {
        let all: Vec<usize> = (0..model.varied.len()).collect();
        let values = model.values(coordinates);
        let parameters = model.varied.iter().zip(&values);
        let tolerances: Vec<f64> = parameters
            .map(|(varied, value)| varied.tolerance(*value))
            .collect();
        let mut slopes = model.slopes(coordinates, &all)?;
        for (column, tolerance) in tolerances.iter().enumerate() {
            slopes.column_mut(column).scale_mut(*tolerance);
        }
        let mut curvature = slopes.transpose() * &slopes;
        for prior in model.prior_terms(coordinates) {
            let index = prior.parameter;
            curvature[(index, index)] += (prior.slope * tolerances[index]).powi(2);
        }
        let here = model.deviations(coordinates)?;
        Ok(Self {
            model,
            coordinates,
            slopes,
            tolerances,
            eigen: SymmetricEigen::new(curvature),
            chi_square: here.iter().map(|deviation| deviation * deviation).sum(),
        })
    }

    /// Returns the effect of setting the damper's parameter at `key` to `value`.
    fn to(&self, key: &str, value: f64) -> Result<Moved, CalibrationError> {
        let damper = self.model.damper_with(self.coordinates, &[(key, value)])?;
        let there = DVector::from_vec(self.model.deviations_of(&damper, self.coordinates)?);
        let chi_square = there.norm_squared();
        let mut gradient = self.slopes.transpose() * there;
        for prior in self.model.prior_terms(self.coordinates) {
            gradient[prior.parameter] +=
                prior.deviation * prior.slope * self.tolerances[prior.parameter];
        }
        let min = MIN_EIGENVALUE_SHARE * self.eigen.eigenvalues.max();
        let vectors = &self.eigen.eigenvectors;
        let along = vectors.transpose() * &gradient;
        let solved = along.zip_map(&self.eigen.eigenvalues, |part, value| {
            if value > min { -part / value } else { 0.0 }
        });
        let gain: f64 = -along.dot(&solved);
        let step = vectors * solved;
        let moved = self.model.varied.iter().zip(self.coordinates).enumerate();
        let moved = moved.map(|(parameter, (varied, coordinate))| {
            let to = (coordinate + step[parameter] * self.tolerances[parameter]).clamp(0.0, 1.0);
            varied.value_at(to) - varied.value_at(*coordinate)
        });
        Ok(Moved {
            shifts: moved.collect(),
            chi_square: chi_square - gain - self.chi_square,
        })
    }
}

/// Widens an interval, which covers the noise, by the shifts due to the assumed parameters. The assumed parameters are
/// independent, so the squares of their shifts add up.
pub(super) fn widened(
    found: f64,
    [lower, upper]: [Option<f64>; 2],
    shifts: impl Iterator<Item = [f64; 2]> + Clone,
) -> [Option<f64>; 2] {
    let sum_of_squares = |distance: &dyn Fn(f64) -> f64| -> f64 {
        let parts = shifts.clone();
        parts
            .map(|shift| shift.map(distance).into_iter().fold(0.0, f64::max).powi(2))
            .sum()
    };
    let (below, above) = (
        sum_of_squares(&|shift| -shift),
        sum_of_squares(&|shift| shift),
    );
    [
        lower.map(|lower| found - ((found - lower).powi(2) + below).sqrt()),
        upper.map(|upper| found + ((upper - found).powi(2) + above).sqrt()),
    ]
}
