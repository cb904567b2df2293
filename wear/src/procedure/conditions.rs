//! Contact patches of a wheel in a running condition.

use std::sync::Arc;

use dashpot_rail::contact::elastic::{ElasticPatch, Fineness, Given, NormalContact, TurnedStrips};
use dashpot_rail::contact::{
    ContactGeometry, Motion, Pair, RailDisplacement, SilhouettePoint, SurfaceError, WheelPose,
    WheelsetContact,
};
use dashpot_rail::creep::{Friction, Polach};

use super::collective::{Condition, Position};
use crate::patch::WearingPatch;

/// A flange cannot be pressed as a condition requires.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "lateral force: {lateral_n} N, allowed: one that the pair reaches at shifts of 0 to 20 mm under {load_n} N"
)]
pub struct SearchError {
    /// The force, N.
    pub lateral_n: f64,
    /// The load, N.
    pub load_n: f64,
}

/// A patch and where it lies.
pub(super) struct PlacedPatch {
    pub wearing: WearingPatch,
    /// Lateral position on the wheel, m from the tread datum.
    pub wheel_y_m: f64,
    /// Lateral position on the rail, m from the track centre.
    pub track_y_m: f64,
}

/// The contact of a pair at a speed.
pub(super) struct Running {
    contact: WheelsetContact<Polach, ContactGeometry>,
    friction: f64,
    speed_m_per_s: f64,
}

/// Shifts at which a pressed flange is searched for: spacing, m, and number; and the number of bisections between two.
const SPACING_M: f64 = 0.5e-3;
const SHIFTS: u32 = 40;
const BISECTIONS: usize = 12;

impl Running {
    pub fn new(
        geometry: ContactGeometry,
        friction: f64,
        speed_m_per_s: f64,
    ) -> Result<Self, SurfaceError> {
        let surface = Friction::constant(friction);
        Ok(Self {
            contact: WheelsetContact::new(Arc::new(geometry), Polach, surface)?,
            friction,
            speed_m_per_s,
        })
    }

    pub fn pair(&self) -> &Pair {
        self.contact.sources()[1].pair()
    }

    /// The loaded patches of the right wheel in a condition.
    pub fn patches(&self, condition: &Condition) -> Result<Vec<PlacedPatch>, SearchError> {
        let geometry = &self.contact.sources()[1];
        let pair = self.pair();
        let wheel = TurnedStrips::new(pair, 0.0, condition.yaw_rad, Fineness::Medium);
        let mut normal = NormalContact::default();
        let lateral_m = match condition.position {
            Position::ShiftM(shift_m) => shift_m,
            Position::PressedN(lateral_n) => {
                let load_n = condition.load_n;
                self.pressed_m(&wheel, lateral_n, load_n)
                    .ok_or(SearchError { lateral_n, load_n })?
            }
        };
        let given = Given::LoadN(condition.load_n);
        geometry.elastic_patches(&wheel, lateral_m, given, &mut normal);
        let motion = Motion {
            speed_m_per_s: self.speed_m_per_s,
            rotation_rad_per_s: self.speed_m_per_s / pair.installation().wheel_radius_m,
            lateral_m,
            vertical_m: normal.depth_m,
            yaw_rad: condition.yaw_rad,
            ..Motion::default()
        };
        let forces = self
            .contact
            .forces(&motion, &[RailDisplacement::default(); 2]);
        let mut silhouette = Vec::new();
        let pose = WheelPose {
            lateral_m,
            yaw_rad: condition.yaw_rad,
            ..WheelPose::default()
        };
        pair.silhouette(&pose, &mut silhouette);
        let points = pair.wheel().points();
        let beside = |point: &SilhouettePoint, y_m: f64| (points[point.index].y_m - y_m).abs();
        let placed = forces.wheels[1].loaded_patches().filter_map(|patch| {
            let y_m = patch.wheel_y_m;
            let nearest = silhouette
                .iter()
                .min_by(|p, q| beside(p, y_m).total_cmp(&beside(q, y_m)))?;
            Some(PlacedPatch {
                wearing: WearingPatch::new(patch, self.speed_m_per_s, self.friction),
                wheel_y_m: y_m,
                track_y_m: nearest.track_y_m,
            })
        });
        Ok(placed.collect())
    }

    /// The smallest shift (to the spacing) at which the normal forces reach a lateral force; `None` if they do not.
    fn pressed_m(&self, wheel: &TurnedStrips<'_>, lateral_n: f64, load_n: f64) -> Option<f64> {
        let mut normal = NormalContact::default();
        let mut presses = |shift_m: f64| {
            let geometry = &self.contact.sources()[1];
            let patches =
                geometry.elastic_patches(wheel, shift_m, Given::LoadN(load_n), &mut normal);
            let lateral = |patch: &ElasticPatch| -patch.load_n * libm::sin(libm::atan(patch.slope));
            patches.iter().map(lateral).sum::<f64>() >= lateral_n
        };
        let mut high = (1..=SHIFTS)
            .map(|shift| SPACING_M * f64::from(shift))
            .find(|shift_m| presses(*shift_m))?;
        let mut low = high - SPACING_M;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            if presses(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(high)
    }
}
