//! The numbers that a calibration varies, as coordinates of a search that keeps them within their bounds.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use super::{CalibrationError, plausible};
use crate::files::damper::{Keyed, range};

/// Key of the time by which the force is recorded later than the displacement (s). It is a number of the rig, not of the damper.
pub const SKEW: &str = "sensor_skew_s";

/// Bounds of the skew (s).
const SKEW_BOUNDS_S: [f64; 2] = [-0.02, 0.02];

/// What is known of a number before any test: a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Prior {
    /// Mean, in the unit of the number.
    pub mean: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
}

/// A number that is varied.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Varied {
    /// `table.key` of the damper file, or [`SKEW`].
    pub key: String,
    /// Where the search starts, in the key's unit.
    pub start: f64,
    /// Least and greatest value.
    pub bounds: [f64; 2],
    /// What is known of it before.
    pub prior: Option<Prior>,
    /// Whether it is searched by equal ratios, else by equal differences.
    #[serde(skip)]
    by_ratio: bool,
}

impl Varied {
    /// The number of `damper` at `key`, between `bounds` where they are given and where it is plausible else, with `prior` where that is
    /// given and what is known of such a number else.
    ///
    /// # Errors
    /// No such number, one that forces do not tell, bounds that are none, or a start outside them.
    pub fn new(
        damper: &Keyed,
        key: &str,
        bounds: Option<[f64; 2]>,
        prior: Option<Prior>,
    ) -> Result<Self, CalibrationError> {
        let start = damper.number(key)?;
        let (table, last) = key.rsplit_once('.').unwrap_or(("", key));
        let plausible = plausible::of(table, last)
            .ok_or_else(|| CalibrationError::NotVaried { key: key.into() })?;
        let [least, greatest] = bounds.unwrap_or(plausible.bounds);
        let is_allowed = |value| range(key).is_some_and(|range| range.contains(value));
        // Equal ratios have no zero.
        let is_ordered = least < greatest && (least > 0.0 || !plausible.by_ratio);
        if !is_ordered || !is_allowed(least) || !is_allowed(greatest) {
            let [a, b] = plausible.bounds;
            return Err(CalibrationError::Bounds {
                key: key.into(),
                bounds: [least, greatest],
                allowed: range(key).map_or("", |range| range.allowed),
                plausible: format!("{a:e} to {b:e}"),
            });
        }
        if !(least..=greatest).contains(&start) {
            return Err(CalibrationError::Start {
                key: key.into(),
                start,
                bounds: [least, greatest],
            });
        }
        Ok(Self {
            key: key.into(),
            start,
            bounds: [least, greatest],
            prior: prior.or(plausible.prior),
            by_ratio: plausible.by_ratio,
        })
    }

    /// The skew between force and displacement.
    pub fn skew() -> Self {
        Self {
            key: SKEW.into(),
            start: 0.0,
            bounds: SKEW_BOUNDS_S,
            prior: None,
            by_ratio: false,
        }
    }

    fn scale(&self, value: f64) -> f64 {
        if self.by_ratio { value.ln() } else { value }
    }

    /// Scaled length of its bounds.
    fn length(&self) -> f64 {
        let [least, greatest] = self.bounds.map(|bound| self.scale(bound));
        greatest - least
    }

    /// Its place between its bounds, 0 to 1.
    pub(super) fn place(&self, value: f64) -> f64 {
        (self.scale(value) - self.scale(self.bounds[0])) / self.length()
    }

    /// Its value at a place.
    pub(super) fn at(&self, place: f64) -> f64 {
        let [least, greatest] = self.bounds;
        let scaled = self.scale(least) + place * self.length();
        let value = if self.by_ratio { scaled.exp() } else { scaled };
        value.clamp(least, greatest)
    }

    /// Its value over place there.
    pub(super) fn slope(&self, value: f64) -> f64 {
        self.length() * if self.by_ratio { value } else { 1.0 }
    }

    /// How far its place may be uncertain, one standard deviation, for it to count as determined: by a tenth of its value, or by a hundredth of
    /// its bounds where that is more and they include zero.
    pub(super) fn tolerance(&self, value: f64) -> f64 {
        if self.by_ratio {
            1.1_f64.ln() / self.length()
        } else {
            (0.1 * value.abs() / self.length()).max(0.01)
        }
    }

    /// How far from the mean of its prior it is, in standard deviations, and that over its place.
    pub(super) fn off_prior(&self, value: f64) -> Option<(f64, f64)> {
        let Prior {
            mean,
            standard_deviation,
        } = self.prior?;
        Some((
            (value - mean) / standard_deviation,
            self.slope(value) / standard_deviation,
        ))
    }
}

/// The place that an angle stands for: the search goes over angles, and no angle leaves the bounds.
pub(super) fn place_of(angle: f64) -> f64 {
    0.5 * (1.0 + angle.sin())
}

/// The angle of a place, a little within the bounds: at them no step would move it.
pub(super) fn angle_of(place: f64) -> f64 {
    const INSIDE: f64 = 1e-3;
    let place = place.clamp(INSIDE, 1.0 - INSIDE);
    (2.0 * place - 1.0).asin().clamp(-FRAC_PI_2, FRAC_PI_2)
}

/// The place over the angle.
pub(super) fn place_slope(angle: f64) -> f64 {
    0.5 * angle.cos()
}
