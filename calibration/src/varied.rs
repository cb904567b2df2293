//! The numbers that a calibration varies, as coordinates of a search that keeps them within their bounds.

use std::f64::consts::FRAC_PI_2;

use serde::Serialize;

use super::loops::LoopTest;
use super::rig::{self, FORCE_OFFSET, SKEW};
use super::{CalibrationError, plausible};
use dashpot_files::damper::{Keyed, range};

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
    /// `table.key` of the damper file, [`SKEW`] or [`FORCE_OFFSET`].
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
    /// Whether the user chose the bounds: a number that ends at one of them is then what was asked for.
    #[serde(skip)]
    pub(super) has_own_bounds: bool,
}

/// A bound that a number is at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bound {
    pub(super) value: f64,
    /// Whether it is the lower one.
    pub(super) is_least: bool,
    /// Whether no damper goes beyond it, as with a clearance of zero.
    pub(super) is_physical: bool,
    /// Whether the user chose it.
    pub(super) is_own: bool,
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
                plausible: [a, b],
            });
        }
        if !(least..=greatest).contains(&start) {
            return Err(CalibrationError::Start {
                key: key.into(),
                start,
                bounds: [least, greatest],
            });
        }
        if let Some(prior) = prior.filter(|prior| !(least..=greatest).contains(&prior.mean)) {
            return Err(CalibrationError::Prior {
                key: key.into(),
                mean: prior.mean,
                bounds: [least, greatest],
            });
        }
        Ok(Self {
            key: key.into(),
            start,
            bounds: [least, greatest],
            prior: prior.or(plausible.prior),
            by_ratio: plausible.by_ratio,
            has_own_bounds: bounds.is_some(),
        })
    }

    /// The number of the rig at `key`, [`SKEW`] or [`FORCE_OFFSET`], for the tests `loops`, between `bounds` where they are given, with `prior`
    /// where that is given. The search starts at zero or at the nearest bound.
    ///
    /// # Errors
    /// Bounds that are not in order or too far out, or a prior outside them.
    pub fn of_rig(
        key: &str,
        loops: &[LoopTest],
        bounds: Option<[f64; 2]>,
        prior: Option<Prior>,
    ) -> Result<Self, CalibrationError> {
        let default = rig::default_bounds(key, loops);
        if let Some(bounds) = bounds {
            rig::check_bounds(key, bounds, default)?;
        }
        let mut varied = Self {
            key: key.into(),
            start: 0.0,
            bounds: bounds.unwrap_or(default),
            prior,
            by_ratio: false,
            has_own_bounds: bounds.is_some(),
        };
        let [least, greatest] = varied.bounds;
        varied.start = 0.0_f64.clamp(least, greatest);
        match prior.filter(|prior| !(least..=greatest).contains(&prior.mean)) {
            Some(prior) => Err(CalibrationError::Prior {
                key: key.into(),
                mean: prior.mean,
                bounds: varied.bounds,
            }),
            None => Ok(varied),
        }
    }

    /// The skew between force and displacement, between default bounds.
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

    /// The offset of the force sensor in the tests `loops`, between default bounds.
    pub fn force_offset(loops: &[LoopTest]) -> Self {
        Self {
            key: FORCE_OFFSET.into(),
            bounds: rig::default_bounds(FORCE_OFFSET, loops),
            ..Self::skew()
        }
    }

    /// Whether it belongs to the rig, not to the damper.
    pub fn is_of_rig(&self) -> bool {
        rig::is_of_rig(&self.key)
    }

    /// The bound that its value is at, within the share `part` of the way between them.
    pub(super) fn bound_at(&self, value: f64, part: f64) -> Option<Bound> {
        let place = self.place(value);
        let at_least = place <= part;
        if !at_least && place < 1.0 - part {
            return None;
        }
        let bound = self.bounds[usize::from(!at_least)];
        // What turns a part of the damper off, such as no clearance or no preload, is no end of what is plausible.
        let is_physical = !self.by_ratio
            && range(&self.key).is_some_and(|range| bound == range.min || bound == range.max);
        Some(Bound {
            value: bound,
            is_least: at_least,
            is_physical,
            is_own: self.has_own_bounds,
        })
    }

    /// Bounds ten times as far out, as far as a damper or a rig may have them; `None` where there is nothing beyond.
    pub(super) fn wider(&self) -> Option<[f64; 2]> {
        const OUT: f64 = 10.0;
        let [least, greatest] = self.bounds;
        let [lowest, highest] = match range(&self.key) {
            Some(range) => [range.min, range.max],
            None => [-rig::largest(&self.key), rig::largest(&self.key)],
        };
        let [least, greatest] = if self.by_ratio {
            [least / OUT, greatest * OUT]
        } else if self.is_of_rig() {
            [least * OUT, greatest * OUT]
        } else {
            [least, greatest + OUT * (greatest - least)]
        };
        let wider = [least.max(lowest), greatest.min(highest)];
        let is_ordered = wider[0] < wider[1] && (wider[0] > 0.0 || !self.by_ratio);
        (is_ordered && wider != self.bounds).then_some(wider)
    }

    /// The same between other bounds.
    pub(super) fn between(&self, bounds: [f64; 2]) -> Self {
        Self {
            start: self.start.clamp(bounds[0], bounds[1]),
            bounds,
            has_own_bounds: true,
            ..self.clone()
        }
    }

    /// Its value in the scale of the search.
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
