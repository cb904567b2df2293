//! The gap between a wheel and its rail: heights of the strips that may touch.

use super::strips::{Strip, TurnedStrips};
use crate::contact::silhouette::Cursor;

/// Number of strips of a group. Groups are looked at by their first strips.
const GROUP: usize = 4;
/// Height by which strips within a group may be closer to the rail than the first ones of this group and the next, m.
const MARGIN_M: f64 = 0.2e-3;

/// The strips of a wheel that are near the rail, at one lateral shift.
#[derive(Debug, Clone, Default)]
pub(in crate::contact) struct Gap {
    /// Strips in rising order. Between strips that are not neighbours on the wheel there is at least one that is out
    /// of reach.
    pub(super) strips: Vec<Strip>,
    /// Depth of each strip below the rail when the tread datum is at the height of the rail's top, m; negative
    /// infinity beside the rail.
    pub(super) heights_m: Vec<f64>,
    /// The greatest height, m.
    pub highest_m: f64,
    /// The lowest height that a strip must have to be in this gap, m.
    pub(super) least_m: f64,
    /// Heights of the first strips of all groups.
    firsts: Vec<f64>,
}

/// Stiffness of a typical contact, N/m^1.5.
const TYPICAL_STIFFNESS: f64 = 1e11;

/// A typical penetration under a load, m.
pub(super) fn typical_penetration_m(load_n: f64) -> f64 {
    libm::pow(load_n / TYPICAL_STIFFNESS, 2.0 / 3.0)
}

/// Height that a contact usually reaches below its greatest height, in typical penetrations; on a steep flange it is
/// three times what it is on the tread.
const REACH: f64 = 4.0;

impl Gap {
    /// Height below the greatest one that strips in contact under a load usually have, m.
    pub fn usual_reach_m(load_n: f64) -> f64 {
        REACH * typical_penetration_m(load_n.clamp(1.0, 1e7))
    }

    /// Position of the highest strip along the wheel's surface, m.
    pub fn summit_m(&self) -> f64 {
        let highest = self
            .heights_m
            .iter()
            .position(|height| *height == self.highest_m);
        highest.map_or(0.0, |entry| self.strips[entry].arc_m)
    }

    /// True if no strip beyond the gap enters the rail at a depth of the tread datum.
    pub fn holds(&self, depth_m: f64) -> bool {
        -depth_m >= self.least_m
    }

    /// Fills the gap with the strips of `wheel` at a lateral shift whose heights exceed `least`, a function of about
    /// the greatest height.
    pub fn fill(
        &mut self,
        wheel: &TurnedStrips<'_>,
        lateral_m: f64,
        least: impl FnOnce(f64) -> f64,
    ) {
        let datum = wheel.pair.installation().datum_offset_m() + lateral_m;
        let mut rail = Cursor::new(wheel.pair);
        let mut height = |strip: &Strip| {
            let rail_z = rail.at(datum + strip.y_m).map(|(z, _)| z);
            rail_z.map_or(f64::NEG_INFINITY, |z| strip.z_m - z)
        };
        self.firsts.clear();
        let firsts = wheel.strips.iter().step_by(GROUP).map(&mut height);
        self.firsts.extend(firsts);
        let highest = |heights: &[f64]| heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        self.least_m = least(highest(&self.firsts));
        self.strips.clear();
        self.heights_m.clear();
        let mut is_open = false;
        for (k, group) in wheel.strips.chunks(GROUP).enumerate() {
            let next = self.firsts.get(k + 1).copied();
            let is_near = |height: f64| height > self.least_m - MARGIN_M;
            if is_near(self.firsts[k]) || next.is_some_and(is_near) {
                self.strips.extend_from_slice(group);
                self.heights_m.extend(group.iter().map(&mut height));
                is_open = true;
            } else if is_open {
                self.strips.push(group[0]);
                self.heights_m.push(self.firsts[k]);
                is_open = false;
            }
        }
        self.highest_m = highest(&self.heights_m);
    }
}

#[cfg(test)]
impl Gap {
    /// The gap of strips whose heights are known.
    pub(super) fn of(strips: Vec<Strip>, heights_m: Vec<f64>) -> Self {
        Self {
            highest_m: heights_m.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            least_m: f64::NEG_INFINITY,
            strips,
            heights_m,
            firsts: Vec::new(),
        }
    }
}
