//! Intervals by the profile of the likelihood: what a number may be when all others follow.

use serde::Serialize;

use super::determined::Determined;
use super::fit::Fit;
use super::model::Model;
use super::varied::Varied;

/// Rise of the sum of squares at the ends of an interval of 95 %, chi-square of one degree of freedom.
pub const RISE_95: f64 = 3.841;

/// Searches a side, at most: the rise is nearly a parabola.
const SEARCHES: usize = 6;

/// A sum of squares lower by this is another minimum, not rounding.
const BETTER: f64 = 0.1;

/// How near the root of the rise comes to that of [`RISE_95`].
const NEAR: f64 = 0.05;

/// The interval of 95 % of a number, and the profile it is from.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Profile {
    /// Least value, `None` where the rise is not reached within the bounds.
    pub least: Option<f64>,
    /// Greatest value, likewise.
    pub greatest: Option<f64>,
    /// Values and the rise of the sum of squares at them, over the inflation of the variance, in the order of the values.
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

    /// Whether a bound comes before the end of the interval on this side.
    pub(super) fn is_open(&self, is_least: bool) -> bool {
        if is_least {
            self.least.is_none()
        } else {
            self.greatest.is_none()
        }
    }

    /// Half of the interval's width; `None` where a bound comes first.
    pub(super) fn half_width(&self) -> Option<f64> {
        Some(0.5 * (self.greatest? - self.least?))
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

/// A better minimum than the one that the profile was to be about.
pub(super) struct Better(pub(super) Fit);

impl Model<'_> {
    /// The profile of the number `number` about `best`; its rise is that of the sum of squares over the inflation.
    ///
    /// # Errors
    /// A better minimum was met on the way.
    pub(super) fn profile(
        &self,
        best: &Fit,
        number: usize,
        determined: &Determined,
    ) -> Result<Profile, Better> {
        let value = |place: f64| self.varied[number].at(place);
        let mut points = vec![(value(best.places[number]), 0.0)];
        let slope = self.varied[number].slope(value(best.places[number]));
        let deviation = determined.standard_deviation / slope;
        let inflation = determined.inflation;
        let least = self.side(best, number, (-deviation, inflation), &mut points)?;
        let greatest = self.side(best, number, (deviation, inflation), &mut points)?;
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(Profile {
            least,
            greatest,
            points,
        })
    }

    /// The end of the interval on the side of the sign of `deviation`; `None` where a bound comes first. Every end was evaluated: where the
    /// search does not come near enough, it is a point beyond.
    fn side(
        &self,
        best: &Fit,
        number: usize,
        (deviation, inflation): (f64, f64),
        points: &mut Vec<(f64, f64)>,
    ) -> Result<Option<f64>, Better> {
        let value = |place: f64| self.varied[number].at(place);
        let (centre, root) = (best.places[number], RISE_95.sqrt());
        let bound = if deviation < 0.0 { 0.0 } else { 1.0 };
        let room = (bound - centre).abs();
        // Linear theory may know nothing of the number.
        let tolerance = self.varied[number].tolerance(value(centre));
        let mut distance = (root * deviation.abs().min(tolerance)).clamp(1e-4, 1.0);
        distance = distance.min(room);
        let mut places = best.places.clone();
        let (mut inside, mut outside) = (0.0, None);
        for _ in 0..SEARCHES {
            places[number] = (centre + distance.copysign(deviation)).clamp(0.0, 1.0);
            let rise = match self.follow(&places, number) {
                Some(fit) => {
                    let rise = (fit.chi_square - best.chi_square) / inflation;
                    if rise < -BETTER {
                        return Err(Better(fit));
                    }
                    places = fit.places;
                    points.push((value(places[number]), rise.max(0.0)));
                    rise.max(1e-6)
                }
                // No damper has such numbers.
                None => f64::INFINITY,
            };
            let reached = rise.sqrt();
            if (reached / root - 1.0).abs() < NEAR {
                return Ok(Some(value(places[number])));
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
            let most = outside.unwrap_or(room);
            // Between what is known on both sides, where the guess leaves that.
            distance = if next > inside && (next < most || outside.is_none()) {
                next.min(room)
            } else {
                0.5 * (inside + most)
            };
        }
        let end = outside.map(|distance| centre + distance.copysign(deviation));
        Ok(end.map(|place| value(place.clamp(0.0, 1.0))))
    }

    /// The least squares with the number `number` held at its place.
    fn follow(&self, places: &[f64], number: usize) -> Option<Fit> {
        let free: Vec<usize> = (0..places.len()).filter(|other| *other != number).collect();
        if !free.is_empty() {
            return self.fit(places, &free);
        }
        let square = |deviation: f64| deviation * deviation;
        let tests = self.deviations(places).ok()?.into_iter().map(square);
        let priors = self
            .off_priors(places)
            .map(|(_, deviation, _)| square(deviation));
        Some(Fit {
            places: places.to_vec(),
            chi_square: tests.chain(priors).sum(),
        })
    }
}
