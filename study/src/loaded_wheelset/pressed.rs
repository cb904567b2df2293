//! A wheelset pressed on its rails by vertical loads, without friction.

use dashpot_rail::contact::elastic::{ElasticPatch, Fineness, Given, NormalContact, TurnedStrips};
use dashpot_rail::contact::{ContactGeometry, RigidContact, WheelPose, ZONES};

use super::LoadedWheelset;

/// Relative error of the vertical load.
const LOAD_TOLERANCE: f64 = 1e-4;
/// Error of the depths of the two wheels against the roll, m.
const DEPTH_TOLERANCE_M: f64 = 1e-8;
/// Maximum number of corrections of a load or of the roll.
const MAX_ROUNDS: usize = 20;
/// Maximum ratio of the normal to the vertical load; on steeper contacts a wheel cannot stand.
const MAX_NORMAL: f64 = 20.0;

/// A wheelset on its rails, without friction.
pub(super) struct Pressed {
    pub roll_rad: f64,
    /// Left wheel (as its mirror image on the right side) and right wheel.
    pub wheels: [PressedWheel; 2],
}

/// One wheel under its vertical load.
pub(super) struct PressedWheel {
    /// Depth of the tread datum below the top of the rail, m.
    pub depth_m: f64,
    patches: [ElasticPatch; ZONES],
}

impl PressedWheel {
    /// Depth of the patches below the tread datum, mean weighted by the loads, m: the rolling radius minus the radius
    /// of the wheel.
    pub fn radius_beyond_datum_m(&self) -> f64 {
        let load_n: f64 = self.patches.iter().map(|patch| patch.load_n).sum();
        let moment: f64 = self
            .patches
            .iter()
            .map(|patch| patch.load_n * patch.wheel_z_m)
            .sum();
        moment / load_n
    }
}

/// Presses wheelsets one after the other; each solution starts from the previous one.
pub(super) struct Press<'a> {
    wheelset: &'a LoadedWheelset,
    fineness: Fineness,
    contacts: [NormalContact; 2],
    /// Normal loads, N.
    normals_n: [f64; 2],
}

impl<'a> Press<'a> {
    pub fn new(wheelset: &'a LoadedWheelset) -> Self {
        let load_n = wheelset.running.load_n;
        Self {
            wheelset,
            fineness: if load_n < 20e3 {
                Fineness::Fine
            } else {
                Fineness::Medium
            },
            contacts: Default::default(),
            normals_n: [load_n; 2],
        }
    }

    /// Presses the wheelset at a lateral shift, at the height of the top of the rails; `None` without equilibrium.
    pub fn at(&mut self, lateral_m: f64, yaw_rad: f64) -> Option<Pressed> {
        if let Some(roll_rad) = self.wheelset.running.roll_rad {
            let wheels = self.wheels(lateral_m, roll_rad, yaw_rad)?;
            return Some(Pressed { roll_rad, wheels });
        }
        let [left, right] = self.wheelset.pairs();
        let distance_m =
            left.installation().datum_offset_m() + right.installation().datum_offset_m();
        let lever_m = distance_m * libm::cos(yaw_rad);
        let rigid = RigidContact::of_sides([left, right], lateral_m, yaw_rad, &mut Vec::new());
        // The secant method for the roll at which one wheel is as much deeper than the other as the roll demands.
        let (mut roll_rad, mut slope) = (rigid.roll_rad, lever_m);
        let mut before: Option<(f64, f64)> = None;
        for _ in 0..MAX_ROUNDS {
            let wheels = self.wheels(lateral_m, roll_rad, yaw_rad)?;
            let [left, right] = &wheels;
            let residual = lever_m * libm::sin(roll_rad) - (right.depth_m - left.depth_m);
            if residual.abs() < DEPTH_TOLERANCE_M {
                return Some(Pressed { roll_rad, wheels });
            }
            if let Some((roll_before, residual_before)) = before {
                let secant = (residual - residual_before) / (roll_rad - roll_before);
                if secant.is_finite() {
                    slope = secant.clamp(0.5 * lever_m, 4.0 * lever_m);
                }
            }
            before = Some((roll_rad, residual));
            roll_rad -= residual / slope;
        }
        None
    }

    fn wheels(&mut self, lateral_m: f64, roll_rad: f64, yaw_rad: f64) -> Option<[PressedWheel; 2]> {
        let left = self.wheel(0, lateral_m, roll_rad, yaw_rad)?;
        let right = self.wheel(1, lateral_m, roll_rad, yaw_rad)?;
        Some([left, right])
    }

    fn wheel(
        &mut self,
        side: usize,
        lateral_m: f64,
        roll_rad: f64,
        yaw_rad: f64,
    ) -> Option<PressedWheel> {
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let geometry: &ContactGeometry = &self.wheelset.contact.sources()[side];
        let pair = geometry.pair();
        let narrowing_m =
            pair.installation().datum_offset_m() * (libm::cos(yaw_rad) * libm::cos(roll_rad) - 1.0);
        let pose = WheelPose {
            lateral_m: sign * lateral_m + narrowing_m,
            roll_rad: sign * roll_rad,
            yaw_rad: sign * yaw_rad,
        };
        let load_n = self.wheelset.running.load_n;
        let strips = TurnedStrips::new(pair, pose.roll_rad, pose.yaw_rad, self.fineness);
        let contact = &mut self.contacts[side];
        let normal_n = &mut self.normals_n[side];
        for _ in 0..MAX_ROUNDS {
            let given = Given::LoadN(*normal_n);
            let patches = geometry.elastic_patches(&strips, pose.lateral_m, given, contact);
            let vertical_n: f64 = patches
                .iter()
                .map(|patch| patch.load_n / libm::hypot(patch.slope, 1.0))
                .sum();
            if (vertical_n / load_n - 1.0).abs() < LOAD_TOLERANCE {
                let depth_m = contact.depth_m;
                return Some(PressedWheel { depth_m, patches });
            }
            let next = *normal_n * load_n / vertical_n;
            if next.is_nan() || next > MAX_NORMAL * load_n {
                break;
            }
            *normal_n = next;
        }
        *normal_n = load_n;
        *contact = NormalContact::default();
        None
    }
}
