//! Intervals from the likelihood profile: one parameter is held at each value while all others are refitted.

use serde::Serialize;

use super::determination::Determined;
use super::fit::Fit;
use super::model::Model;
use super::varied::Varied;

/// Rise of the sum of squares at the ends of a 95 % interval: chi-square with one degree of freedom.
pub const RISE_95: f64 = 3.841;

/// Maximum number of fits per side. A few suffice, because the rise is nearly a parabola.
const MAX_FITS: usize = 6;

/// A sum of squares that is lower by more than this belongs to a different minimum and is not due to rounding.
const BETTER: f64 = 0.1;

/// Relative tolerance of the square root of the rise at an end.
const END_TOLERANCE: f64 = 0.05;

/// 95 % interval of a parameter, and the likelihood profile that it comes from.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Profile {
    /// Lower end; `None` if it lies beyond the lower bound.
    #[serde(rename = "least")]
    pub lower: Option<f64>,
    /// Upper end; `None` if it lies beyond the upper bound.
    #[serde(rename = "greatest")]
    pub upper: Option<f64>,
    /// Values in rising order, each with the rise of the sum of squares divided by the variance inflation factor.
    pub points: Vec<(f64, f64)>,
}

impl Profile {
    /// True if the interval is so much narrower than the prior that the tests determine the parameter.
    pub fn is_determined_by_tests(&self, varied: &Varied) -> bool {
        let known = varied
            .prior
            .map_or(f64::INFINITY, |prior| prior.standard_deviation);
        let [lower, upper] = varied.bounds;
        let width = self.upper.unwrap_or(upper) - self.lower.unwrap_or(lower);
        width < RISE_95.sqrt() * known
    }

    /// True if the interval extends beyond the lower or the upper bound.
    pub(super) fn is_open(&self, is_lower: bool) -> bool {
        if is_lower {
            self.lower.is_none()
        } else {
            self.upper.is_none()
        }
    }

    /// Returns half the width of the interval; `None` if it extends beyond a bound.
    pub(super) fn half_width(&self) -> Option<f64> {
        Some(0.5 * (self.upper? - self.lower?))
    }

    /// True if the interval is no wider than the tolerance of the parameter allows, and at least one end is within the
    /// bounds.
    pub(super) fn is_narrow(&self, varied: &Varied, value: f64) -> bool {
        let [lower, upper] = varied.bounds;
        let ends = [self.lower.unwrap_or(lower), self.upper.unwrap_or(upper)];
        let [lower, upper] = ends.map(|end| varied.coordinate(end));
        let is_open = self.lower.is_none() && self.upper.is_none();
        !is_open && upper - lower <= 2.0 * RISE_95.sqrt() * varied.tolerance(value)
    }
}

/// A better minimum than the one that the profile started from.
pub(super) struct Better(pub(super) Fit);

impl Model<'_> {
    /// Computes the likelihood profile of a parameter about `best`.
    ///
    /// # Errors
    /// Returns a better minimum if the search finds one.
    pub(super) fn profile(
        &self,
        best: &Fit,
        parameter: usize,
        determined: &Determined,
    ) -> Result<Profile, Better> {
        let value = |coordinate: f64| self.varied[parameter].value_at(coordinate);
        let mut points = vec![(value(best.coordinates[parameter]), 0.0)];
        let slope = self.varied[parameter].slope(value(best.coordinates[parameter]));
        let deviation = determined.standard_deviation / slope;
        let inflation = determined.inflation;
        let lower = self.side(best, parameter, -deviation, inflation, &mut points)?;
        let upper = self.side(best, parameter, deviation, inflation, &mut points)?;
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(Profile {
            lower,
            upper,
            points,
        })
    }

    /// Returns the end of the interval on the side given by the sign of `deviation`; `None` if it lies beyond a bound.
    ///
    /// The end is always an evaluated point; if the search does not converge, it is a point outside the interval.
    fn side(
        &self,
        best: &Fit,
        parameter: usize,
        deviation: f64,
        inflation: f64,
        points: &mut Vec<(f64, f64)>,
    ) -> Result<Option<f64>, Better> {
        let value = |coordinate: f64| self.varied[parameter].value_at(coordinate);
        let (centre, root) = (best.coordinates[parameter], RISE_95.sqrt());
        let bound = if deviation < 0.0 { 0.0 } else { 1.0 };
        let room = (bound - centre).abs();
        // Linear theory may give no useful deviation.
        let tolerance = self.varied[parameter].tolerance(value(centre));
        let mut distance = (root * deviation.abs().min(tolerance)).clamp(1e-4, 1.0);
        distance = distance.min(room);
        let mut coordinates = best.coordinates.clone();
        let (mut inside, mut outside) = (0.0, None);
        for _ in 0..MAX_FITS {
            coordinates[parameter] = (centre + distance.copysign(deviation)).clamp(0.0, 1.0);
            let rise = match self.refit_others(&coordinates, parameter) {
                Some(fit) => {
                    let rise = (fit.chi_square - best.chi_square) / inflation;
                    if rise < -BETTER {
                        return Err(Better(fit));
                    }
                    coordinates = fit.coordinates;
                    points.push((value(coordinates[parameter]), rise.max(0.0)));
                    rise.max(1e-6)
                }
                // An invalid combination of parameters lies outside the interval.
                None => f64::INFINITY,
            };
            let reached = rise.sqrt();
            if (reached / root - 1.0).abs() < END_TOLERANCE {
                return Ok(Some(value(coordinates[parameter])));
            }
            if reached < root {
                if distance >= room {
                    return Ok(None);
                }
                inside = distance;
            } else {
                outside = Some(distance);
            }
            let next = distance * (root / reached).clamp(0.2, 5.0);
            let limit = outside.unwrap_or(room);
            // Bisects if the guess lies outside the bracket.
            distance = if next > inside && (next < limit || outside.is_none()) {
                next.min(room)
            } else {
                0.5 * (inside + limit)
            };
        }
        let end = outside.map(|distance| centre + distance.copysign(deviation));
        Ok(end.map(|coordinate| value(coordinate.clamp(0.0, 1.0))))
    }

    /// Refits all other parameters with `parameter` held.
    fn refit_others(&self, coordinates: &[f64], parameter: usize) -> Option<Fit> {
        let free: Vec<usize> = (0..coordinates.len())
            .filter(|other| *other != parameter)
            .collect();
        if !free.is_empty() {
            return self.fit(coordinates, &free);
        }
        let square = |deviation: f64| deviation * deviation;
        let tests = self.deviations(coordinates).ok()?.into_iter().map(square);
        let priors = self
            .prior_terms(coordinates)
            .map(|prior| square(prior.deviation));
        Some(Fit {
            coordinates: coordinates.to_vec(),
            chi_square: tests.chain(priors).sum(),
        })
    }
}
