//! The contact at the nodes of one roll and one yaw.

use super::conservation::Solved;
use super::{LEVELS, ROOTS};
use crate::contact::elastic::{ElasticPatch, Fineness, Gap, Given, NormalContact, TurnedStrips};
use crate::contact::geometry::ContactGeometry;
use crate::contact::zones::ZONES;

/// Strips for each load.
const FINENESS: [Fineness; LEVELS] = [
    Fineness::Fine,
    Fineness::Fine,
    Fineness::Medium,
    Fineness::Medium,
    Fineness::Coarse,
    Fineness::Coarse,
    Fineness::Coarse,
];

/// Relative error of the lengths of strips; the load is off by a third of it.
const LENGTH_TOLERANCE: f64 = 2e-3;
/// Load of a level, N.
pub(super) fn load_n(level: usize) -> f64 {
    ROOTS[level].powi(3)
}

/// A turned wheel divided into fine, medium and coarse strips, and its last solutions.
pub(super) struct Row<'a> {
    geometry: &'a ContactGeometry,
    wheels: [TurnedStrips<'a>; 3],
    gaps: [Gap; 3],
    contacts: [NormalContact; LEVELS],
}

impl<'a> Row<'a> {
    pub fn new(geometry: &'a ContactGeometry, roll_rad: f64, yaw_rad: f64) -> Self {
        let strips = |fineness| TurnedStrips::new(geometry.pair(), roll_rad, yaw_rad, fineness);
        Self {
            geometry,
            wheels: [Fineness::Fine, Fineness::Medium, Fineness::Coarse].map(strips),
            gaps: Default::default(),
            contacts: std::array::from_fn(|_| NormalContact::with_tolerance(LENGTH_TOLERANCE)),
        }
    }

    /// Moves the wheel to a lateral shift.
    pub fn shift(&mut self, lateral_m: f64) {
        for (fineness, (wheel, gap)) in self.wheels.iter().zip(&mut self.gaps).enumerate() {
            let levels = (0..LEVELS).filter(|level| FINENESS[*level] as usize == fineness);
            let max_load_n = levels.map(load_n).fold(0.0, f64::max);
            let reach_m = Gap::usual_reach_m(max_load_n);
            gap.fill(wheel, lateral_m, |highest_m| highest_m - reach_m);
        }
    }

    /// Depth and patches under a load, at the shift that the wheel was moved to.
    pub fn solve(&mut self, lateral_m: f64, level: usize) -> (f64, [ElasticPatch; ZONES]) {
        let fineness = FINENESS[level] as usize;
        let (wheel, gap) = (&self.wheels[fineness], &self.gaps[fineness]);
        let contact = &mut self.contacts[level];
        let given = Given::LoadN(load_n(level));
        contact.solve(gap, self.geometry.steel(), given);
        let patches = if gap.holds(contact.depth_m) {
            self.geometry.patches_in(gap, lateral_m, contact)
        } else {
            self.geometry
                .elastic_patches(wheel, lateral_m, given, contact)
        };
        (contact.depth_m, patches)
    }

    /// The contact under each load at a lateral shift; `None` if the wheel is beside the rail.
    pub fn solve_all(&mut self, lateral_m: f64) -> Option<Solved> {
        self.shift(lateral_m);
        let first_touch_m = self.first_touch_m();
        first_touch_m.is_finite().then(|| Solved {
            lateral_m,
            first_touch_m,
            levels: std::array::from_fn(|level| self.solve(lateral_m, level)),
        })
    }

    /// Depth, m, of the highest strip of the wheel below the top of the rail; infinite beside the rail.
    fn first_touch_m(&self) -> f64 {
        -self.gaps[0].highest_m
    }

    /// Depth, m, lateral force divided by the load, and position on the wheel, m, at a lateral shift.
    pub fn depth_force_and_position(&mut self, lateral_m: f64, level: usize) -> [f64; 3] {
        self.shift(lateral_m);
        let (depth_m, patches) = self.solve(lateral_m, level);
        let (mut force, mut position) = (0.0, 0.0);
        for patch in &patches {
            let part = patch.load_n / load_n(level);
            force += part * patch.slope / libm::hypot(patch.slope, 1.0);
            position += part * patch.wheel_y_m;
        }
        [depth_m, force, position]
    }

    /// Part of the load that the flange carries at a lateral shift.
    pub fn part_on_flange(&mut self, lateral_m: f64, level: usize) -> f64 {
        self.shift(lateral_m);
        let (_, [flange, ..]) = self.solve(lateral_m, level);
        flange.load_n / load_n(level)
    }
}
