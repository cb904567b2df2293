//! Patches and forces of a wheelset under load, as reports list them.

use dashpot_rail::contact::{PatchForces, WheelForces};
use dashpot_rail::creep::Creepage;
use serde::Serialize;

use super::equilibrium::Equilibrium;

/// Distance between the positions of two zones that belong to one patch, m.
const SAME_PLACE_M: f64 = 1e-6;

/// A wheelset under load at one lateral shift.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LoadedShift {
    /// Lateral shift at the height of the top of the rails, positive to the right, m.
    pub lateral_shift_m: f64,
    /// Roll, right side down positive, rad.
    pub roll_rad: Option<f64>,
    /// Depth of the wheelset, m; zero if the tread datum of a wheelset without roll is level with the top of the rails.
    pub vertical_shift_m: Option<f64>,
    /// Angular velocity about the axle, rad/s.
    pub rotation_rad_per_s: Option<f64>,
    /// Rolling radius of the right wheel minus that of the left wheel, m.
    pub rolling_radius_difference_m: Option<f64>,
    /// Left wheel; `None` if the wheelset has no equilibrium under its load.
    pub left: Option<LoadedWheel>,
    /// Right wheel.
    pub right: Option<LoadedWheel>,
}

/// One wheel under load.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LoadedWheel {
    /// `Q`: vertical force of the wheel on the rail, down positive, N.
    pub vertical_force_n: f64,
    /// `Y`: lateral force of the wheel on the rail, positive to the field side, N.
    pub lateral_force_n: f64,
    /// `Y/Q`.
    pub derailment_coefficient: f64,
    /// Longitudinal force of the rail on the wheel, forward positive, N.
    pub longitudinal_force_n: f64,
    /// Mean of the patches weighted by their loads, m.
    pub rolling_radius_m: f64,
    /// The patches, from the flange to the field side.
    pub patches: Vec<LoadedPatch>,
}

/// One contact patch. Lateral quantities are positive to the field side; forces and moments act on the wheel. Those of
/// the left wheel are of its mirror image.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct LoadedPatch {
    /// Normal load, N.
    pub load_n: f64,
    /// Lateral position on the wheel from the tread datum, m.
    pub wheel_y_m: f64,
    /// Lateral distance from the track centre, m.
    pub track_y_m: f64,
    /// Depth below the top of the rails, m.
    pub track_z_m: f64,
    /// Contact angle against the track plane; positive on a cone that widens towards the flange, rad.
    pub contact_angle_rad: f64,
    /// Semi-axis in the rolling direction of the ellipse with the area and the width of the patch, m.
    pub semi_axis_rolling_m: f64,
    /// Semi-axis across, m.
    pub semi_axis_across_m: f64,
    /// Maximum pressure, Pa.
    pub peak_pressure_pa: f64,
    /// Rolling radius, m.
    pub rolling_radius_m: f64,
    /// Creepage in the rolling direction: velocity of the wheel's surface relative to the rail, divided by the speed.
    pub longitudinal_creepage: f64,
    /// Creepage across.
    pub lateral_creepage: f64,
    /// Spin, 1/m.
    pub spin_creepage_per_m: f64,
    /// Creep force in the rolling direction, N.
    pub longitudinal_creep_force_n: f64,
    /// Creep force along the common tangent across, N.
    pub lateral_creep_force_n: f64,
    /// Moment about the normal, N m.
    pub spin_moment_n_m: f64,
    /// Power dissipated by friction, W.
    pub dissipation_w: f64,
}

impl LoadedShift {
    /// A shift at which the wheelset has no equilibrium.
    pub(super) fn without_equilibrium(lateral_shift_m: f64) -> Self {
        Self {
            lateral_shift_m,
            roll_rad: None,
            vertical_shift_m: None,
            rotation_rad_per_s: None,
            rolling_radius_difference_m: None,
            left: None,
            right: None,
        }
    }

    /// The wheelset in `equilibrium`; `radius_m` is the nominal radius of both wheels.
    pub(super) fn new(lateral_shift_m: f64, equilibrium: &Equilibrium, radius_m: f64) -> Self {
        let Equilibrium {
            motion,
            rails,
            forces,
        } = equilibrium;
        let wheel = |side: usize| {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            let coefficient = forces.derailment_coefficients()[side];
            let below_top_m = motion.vertical_m - rails[side].vertical_m - radius_m;
            let beside_centre_m = sign * motion.lateral_m;
            LoadedWheel::new(
                &forces.wheels[side],
                sign,
                coefficient,
                [beside_centre_m, below_top_m],
            )
        };
        let (left, right) = (wheel(0), wheel(1));
        Self {
            lateral_shift_m,
            roll_rad: Some(motion.roll_rad),
            vertical_shift_m: Some(motion.vertical_m),
            rotation_rad_per_s: Some(motion.rotation_rad_per_s),
            rolling_radius_difference_m: Some(right.rolling_radius_m - left.rolling_radius_m),
            left: Some(left),
            right: Some(right),
        }
    }

    /// The wheels with their sides, -1 for the left and 1 for the right.
    pub fn wheels(&self) -> impl Iterator<Item = (i8, &LoadedWheel)> {
        let left = self.left.iter().map(|wheel| (-1, wheel));
        left.chain(self.right.iter().map(|wheel| (1, wheel)))
    }
}

impl LoadedWheel {
    fn new(
        forces: &WheelForces,
        sign: f64,
        derailment_coefficient: f64,
        [beside_centre_m, below_top_m]: [f64; 2],
    ) -> Self {
        let mut patches: Vec<LoadedPatch> = Vec::new();
        for zone in forces.loaded_patches() {
            let patch = LoadedPatch::new(zone, sign, beside_centre_m, below_top_m);
            match patches.last_mut() {
                Some(last) if last.is_same_as(&patch) => last.add(&patch),
                _ => patches.push(patch),
            }
        }
        let load_n: f64 = patches.iter().map(|patch| patch.load_n).sum();
        let moment: f64 = patches
            .iter()
            .map(|patch| patch.load_n * patch.rolling_radius_m)
            .sum();
        let [fx, fy, fz] = forces.force_n;
        Self {
            vertical_force_n: -fz,
            lateral_force_n: -sign * fy,
            derailment_coefficient,
            longitudinal_force_n: fx,
            rolling_radius_m: moment / load_n,
            patches,
        }
    }
}

impl LoadedPatch {
    fn new(zone: &PatchForces, sign: f64, beside_centre_m: f64, below_top_m: f64) -> Self {
        let Creepage {
            longitudinal,
            lateral,
            spin_per_m,
        } = zone.creepage;
        let [longitudinal_n, lateral_n, moment_n_m] = zone.creep.components();
        Self {
            load_n: zone.load_n,
            wheel_y_m: zone.wheel_y_m,
            track_y_m: sign * zone.position_m[1] + beside_centre_m,
            track_z_m: zone.position_m[2] + below_top_m,
            contact_angle_rad: zone.contact_angle_rad(),
            semi_axis_rolling_m: zone.semi_axes_m[0],
            semi_axis_across_m: zone.semi_axes_m[1],
            peak_pressure_pa: zone.peak_pressure_pa,
            rolling_radius_m: zone.rolling_radius_m,
            longitudinal_creepage: longitudinal,
            lateral_creepage: lateral,
            spin_creepage_per_m: spin_per_m,
            longitudinal_creep_force_n: longitudinal_n,
            lateral_creep_force_n: lateral_n,
            spin_moment_n_m: moment_n_m,
            dissipation_w: zone.dissipation_w,
        }
    }

    /// True if `next`, the patch of the next zone, is a part of the same patch.
    fn is_same_as(&self, next: &Self) -> bool {
        (self.wheel_y_m - next.wheel_y_m).abs() < SAME_PLACE_M
    }

    /// Adds another part of the same patch. The normal forces of the parts may have different directions.
    fn add(&mut self, next: &Self) {
        let [across, up] = [self, next]
            .map(|part| (part.load_n, part.contact_angle_rad))
            .map(|(load_n, angle)| [load_n * libm::sin(angle), load_n * libm::cos(angle)])
            .into_iter()
            .fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
        self.load_n = libm::hypot(across, up);
        self.contact_angle_rad = libm::atan2(across, up);
        self.peak_pressure_pa = self.peak_pressure_pa.max(next.peak_pressure_pa);
        self.longitudinal_creep_force_n += next.longitudinal_creep_force_n;
        self.lateral_creep_force_n += next.lateral_creep_force_n;
        self.spin_moment_n_m += next.spin_moment_n_m;
        self.dissipation_w += next.dissipation_w;
    }
}
