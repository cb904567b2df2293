//! Intervals by the profile of the likelihood: what a number may be when all others follow.

use serde::Serialize;

use super::fit::Fit;
use super::model::Model;
use super::varied::Varied;

/// Rise of the sum of squares at the ends of an interval of 95 %, chi-square of one degree of freedom.
pub const RISE_95: f64 = 3.841;

/// Searches a side, at most: the rise is nearly a parabola.
const SEARCHES: usize = 6;

/// How near the root of the rise comes to that of [`RISE_95`].
const NEAR: f64 = 0.05;

/// The interval of 95 % of a number, and the profile it is from.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Profile {
    /// Least value, `None` where the rise is not reached within the bounds.
    pub least: Option<f64>,
    /// Greatest value, likewise.
    pub greatest: Option<f64>,
    /// Values and the rise of the sum of squares at them, in the order of the values.
    pub points: Vec<(f64, f64)>,
}

impl Profile {
    /// Whether the interval is so much narrower than what was known before that the tests tell the number.
    pub fn is_by_tests(&self, varied: &Varied) -> bool {
        let known = varied
            .prior
            .map_or(f64::INFINITY, |prior| prior.standard_deviation);
        let [least, greatest] = varied.bounds;
        let width = self.greatest.unwrap_or(greatest) - self.least.unwrap_or(least);
        width < RISE_95.sqrt() * known
    }

    /// Whether the interval is as narrow as that of a number whose standard deviation is tolerated, and not only as the bounds are.
    pub(super) fn is_narrow(&self, varied: &Varied, value: f64) -> bool {
        let [least, greatest] = varied.bounds;
        let ends = [
            self.least.unwrap_or(least),
            self.greatest.unwrap_or(greatest),
        ];
        let [least, greatest] = ends.map(|end| varied.place(end));
        let is_open = self.least.is_none() && self.greatest.is_none();
        !is_open && greatest - least <= 2.0 * RISE_95.sqrt() * varied.tolerance(value)
    }
}

impl Model {
    /// The profile of the number `number` about `best`, whose standard deviation is about `deviation`, as a place.
    pub(super) fn profile(&self, best: &Fit, number: usize, deviation: f64) -> Profile {
        let value = |place: f64| self.varied[number].at(place);
        // Linear theory may know nothing of it.
        let tolerance = self.varied[number].tolerance(value(best.places[number]));
        let deviation = deviation.min(tolerance);
        let mut points = vec![(value(best.places[number]), 0.0)];
        let mut side = |sign: f64, bound: f64| -> Option<f64> {
            let (centre, root) = (best.places[number], RISE_95.sqrt());
            let room = (bound - centre).abs();
            let mut distance = (root * deviation).clamp(1e-4, 1.0).min(room);
            let mut places = best.places.clone();
            let (mut inside, mut outside) = (0.0, f64::INFINITY);
            for _ in 0..SEARCHES {
                places[number] = (centre + sign * distance).clamp(0.0, 1.0);
                let free: Vec<usize> = (0..places.len()).filter(|other| *other != number).collect();
                let rise = match free.is_empty() {
                    true => self.chi_square(&places)?,
                    false => {
                        let fit = self.fit(&places, &free)?;
                        places = fit.places;
                        fit.chi_square
                    }
                } - best.chi_square;
                points.push((value(places[number]), rise.max(0.0)));
                let reached = rise.max(1e-6).sqrt();
                if (reached / root - 1.0).abs() < NEAR {
                    return Some(value(places[number]));
                }
                if reached < root {
                    if distance >= room {
                        return None;
                    }
                    inside = distance;
                } else {
                    outside = distance;
                }
                let next = distance * (root / reached).clamp(0.2, 5.0);
                // Between what is known on both sides, where the guess leaves that.
                distance = if next > inside && next < outside {
                    next.min(room)
                } else {
                    0.5 * (inside + outside.min(room))
                };
            }
            Some(value((centre + sign * distance).clamp(0.0, 1.0)))
        };
        let (least, greatest) = (side(-1.0, 0.0), side(1.0, 1.0));
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Profile {
            least,
            greatest,
            points,
        }
    }

    /// Sum of the squares of all deviations at `places`.
    fn chi_square(&self, places: &[f64]) -> Option<f64> {
        let tests = self.deviations(places).ok()?;
        let priors = self
            .off_priors(places)
            .map(|(_, deviation, _)| deviation * deviation);
        let priors: f64 = priors.sum();
        Some(
            priors
                + tests
                    .iter()
                    .map(|deviation| deviation * deviation)
                    .sum::<f64>(),
        )
    }
}
