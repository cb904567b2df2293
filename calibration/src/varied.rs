//! Parameters that a calibration varies, and their normalised coordinates from 0 to 1 between the bounds.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use super::keys::{FORCE_OFFSET, SKEW};
use super::loops::LoopTest;
use super::prior::Prior;
use super::rig;
use super::{CalibrationError, plausible};
use dashpot_files::damper::{KeyedParameters, range};

/// A parameter that is varied.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Varied {
    /// `table.key` of the damper file, [`SKEW`] or [`FORCE_OFFSET`]; with `@N` if it belongs to test N alone.
    pub key: String,
    /// Where the search starts, in the key's unit.
    pub start: f64,
    /// Lower and upper bound.
    pub bounds: [f64; 2],
    /// Optional prior.
    pub prior: Option<Prior>,
    /// True for a logarithmic scale, false for a linear one.
    #[serde(skip)]
    by_ratio: bool,
    /// True if the user chose the bounds; a parameter may then end at one of them.
    #[serde(skip)]
    pub(super) has_own_bounds: bool,
}

/// Splits a key such as `force_offset_n@2` into the parameter and the number of the test.
pub(super) fn split_key(key: &str) -> (&str, Option<usize>) {
    let own = key.rsplit_once('@');
    let own = own.and_then(|(base, test)| Some((base, test.parse().ok()?)));
    own.map_or((key, None), |(base, test)| (base, Some(test)))
}

/// A bound that a parameter is at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bound {
    pub(super) value: f64,
    /// True for the lower bound.
    pub(super) is_lower: bool,
    /// True for a physical limit, such as zero clearance.
    pub(super) is_physical: bool,
    /// True if the user chose the bound.
    pub(super) is_own: bool,
}

impl Varied {
    /// Varies the parameter of `damper` at `key`, by default within its plausible range and with its default prior.
    ///
    /// # Errors
    /// Returns an error for an unknown parameter, a parameter that cannot be calibrated from forces, invalid bounds, or
    /// a start or prior mean outside the bounds.
    pub fn new(
        damper: &KeyedParameters,
        key: &str,
        bounds: Option<[f64; 2]>,
        prior: Option<Prior>,
    ) -> Result<Self, CalibrationError> {
        let (base, _) = split_key(key);
        let start = damper.number(base)?;
        let (table, last) = base.rsplit_once('.').unwrap_or(("", base));
        let plausible = plausible::plausible(table, last)
            .ok_or_else(|| CalibrationError::NotVaried { key: key.into() })?;
        let [lower, upper] = bounds.unwrap_or(plausible.bounds);
        let is_allowed = |value| range(base).is_some_and(|range| range.contains(value));
        // A logarithmic scale excludes zero.
        let is_ordered = lower < upper && (lower > 0.0 || !plausible.by_ratio);
        if !is_ordered || !is_allowed(lower) || !is_allowed(upper) {
            let [a, b] = plausible.bounds;
            return Err(CalibrationError::Bounds {
                key: key.into(),
                bounds: [lower, upper],
                allowed: range(base).map_or("", |range| range.allowed),
                plausible: [a, b],
            });
        }
        if !(lower..=upper).contains(&start) {
            return Err(CalibrationError::Start {
                key: key.into(),
                start,
                bounds: [lower, upper],
            });
        }
        if let Some(prior) = prior.filter(|prior| !(lower..=upper).contains(&prior.mean)) {
            return Err(CalibrationError::Prior {
                key: key.into(),
                mean: prior.mean,
                bounds: [lower, upper],
            });
        }
        Ok(Self {
            key: key.into(),
            start,
            bounds: [lower, upper],
            prior: prior.or(plausible.prior),
            by_ratio: plausible.by_ratio,
            has_own_bounds: bounds.is_some(),
        })
    }

    /// Varies the rig parameter at `key`, [`SKEW`] or [`FORCE_OFFSET`], for the tests `loops`.
    ///
    /// The search starts at zero or, if that is out of bounds, at the nearest bound.
    ///
    /// # Errors
    /// Returns an error for invalid bounds, or for a prior mean outside the bounds.
    pub fn rig(
        key: &str,
        loops: &[LoopTest],
        bounds: Option<[f64; 2]>,
        prior: Option<Prior>,
    ) -> Result<Self, CalibrationError> {
        let (base, _) = split_key(key);
        let default = rig::default_bounds(base, loops);
        if let Some(bounds) = bounds {
            rig::check_bounds(base, bounds, default)?;
        }
        let mut varied = Self {
            key: key.into(),
            start: 0.0,
            bounds: bounds.unwrap_or(default),
            prior,
            by_ratio: false,
            has_own_bounds: bounds.is_some(),
        };
        let [lower, upper] = varied.bounds;
        varied.start = 0.0_f64.clamp(lower, upper);
        match prior.filter(|prior| !(lower..=upper).contains(&prior.mean)) {
            Some(prior) => Err(CalibrationError::Prior {
                key: key.into(),
                mean: prior.mean,
                bounds: varied.bounds,
            }),
            None => Ok(varied),
        }
    }

    /// Varies the skew between force and displacement within its default bounds.
    pub fn skew() -> Self {
        Self {
            key: SKEW.into(),
            start: 0.0,
            bounds: rig::default_bounds(SKEW, &[]),
            prior: None,
            by_ratio: false,
            has_own_bounds: false,
        }
    }

    /// Varies the offset of the force sensor within its default bounds for the tests `loops`.
    pub fn force_offset(loops: &[LoopTest]) -> Self {
        Self {
            key: FORCE_OFFSET.into(),
            bounds: rig::default_bounds(FORCE_OFFSET, loops),
            ..Self::skew()
        }
    }

    /// True for a rig parameter, false for a damper parameter.
    pub fn is_rig_parameter(&self) -> bool {
        rig::is_rig_parameter(self.base())
    }

    /// Returns the key without the number of the test.
    pub fn base(&self) -> &str {
        split_key(&self.key).0
    }

    /// Returns the number of the test, from 1, to which the parameter belongs alone.
    pub fn test(&self) -> Option<usize> {
        split_key(&self.key).1
    }

    /// Returns the bound that a value is at; `tolerance` is the allowed distance as a share of the range.
    pub(super) fn bound_at(&self, value: f64, tolerance: f64) -> Option<Bound> {
        let coordinate = self.coordinate(value);
        let is_lower = coordinate <= tolerance;
        if !is_lower && coordinate < 1.0 - tolerance {
            return None;
        }
        let bound = self.bounds[usize::from(!is_lower)];
        // A value that turns a part of the damper off, such as zero clearance or preload, is a physical limit.
        let is_physical = !self.by_ratio
            && range(self.base()).is_some_and(|range| bound == range.min || bound == range.max);
        Some(Bound {
            value: bound,
            is_lower,
            is_physical,
            is_own: self.has_own_bounds,
        })
    }

    /// Returns bounds ten times as wide, limited to allowed values; `None` if the bounds cannot be widened.
    pub(super) fn wider(&self) -> Option<[f64; 2]> {
        const FACTOR: f64 = 10.0;
        let [lower, upper] = self.bounds;
        let [lowest, highest] = match range(self.base()) {
            Some(range) => [range.min, range.max],
            None => [
                -rig::max_magnitude(self.base()),
                rig::max_magnitude(self.base()),
            ],
        };
        let [lower, upper] = if self.by_ratio {
            [lower / FACTOR, upper * FACTOR]
        } else if self.is_rig_parameter() {
            [lower * FACTOR, upper * FACTOR]
        } else {
            [lower, upper + FACTOR * (upper - lower)]
        };
        let wider = [lower.max(lowest), upper.min(highest)];
        let is_ordered = wider[0] < wider[1] && (wider[0] > 0.0 || !self.by_ratio);
        (is_ordered && wider != self.bounds).then_some(wider)
    }

    /// Returns the same parameter with other bounds.
    pub(super) fn with_bounds(&self, bounds: [f64; 2]) -> Self {
        Self {
            start: self.start.clamp(bounds[0], bounds[1]),
            bounds,
            has_own_bounds: true,
            ..self.clone()
        }
    }

    /// Returns a value on the scale of the search, logarithmic or linear.
    fn scale(&self, value: f64) -> f64 {
        if self.by_ratio { value.ln() } else { value }
    }

    /// Returns the distance between the bounds on the scale of the search.
    fn length(&self) -> f64 {
        let [lower, upper] = self.bounds.map(|bound| self.scale(bound));
        upper - lower
    }

    /// Returns the normalised coordinate of a value: 0 at the lower bound, 1 at the upper.
    pub(super) fn coordinate(&self, value: f64) -> f64 {
        (self.scale(value) - self.scale(self.bounds[0])) / self.length()
    }

    /// Returns the value at a coordinate.
    pub(super) fn value_at(&self, coordinate: f64) -> f64 {
        let [lower, upper] = self.bounds;
        let scaled = self.scale(lower) + coordinate * self.length();
        let value = if self.by_ratio { scaled.exp() } else { scaled };
        value.clamp(lower, upper)
    }

    /// Returns the derivative of the value with respect to the coordinate.
    pub(super) fn slope(&self, value: f64) -> f64 {
        self.length() * if self.by_ratio { value } else { 1.0 }
    }

    /// Returns the largest standard deviation of the coordinate with which the parameter counts as determined.
    ///
    /// It corresponds to 10 % of the value or, on a linear scale, at least 1 % of the range.
    pub(super) fn tolerance(&self, value: f64) -> f64 {
        if self.by_ratio {
            1.1_f64.ln() / self.length()
        } else {
            (0.1 * value.abs() / self.length()).max(0.01)
        }
    }
}

/// Returns the coordinate of an angle. The search varies angles, because the coordinate of every angle is within the
/// bounds.
pub(super) fn coordinate_at(angle: f64) -> f64 {
    0.5 * (1.0 + angle.sin())
}

/// Returns the angle of a coordinate, kept slightly inside the bounds, where the derivative would vanish.
pub(super) fn angle_at(coordinate: f64) -> f64 {
    const INSIDE: f64 = 1e-3;
    let coordinate = coordinate.clamp(INSIDE, 1.0 - INSIDE);
    (2.0 * coordinate - 1.0).asin().clamp(-FRAC_PI_2, FRAC_PI_2)
}

/// Returns the derivative of the coordinate with respect to the angle.
pub(super) fn coordinate_slope(angle: f64) -> f64 {
    0.5 * angle.cos()
}
