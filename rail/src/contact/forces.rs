//! Results of the contact: forces on patches, wheels and the wheelset, and the state of each wheel.

use super::motion::MOTION_FIELDS;
use super::wheel::Wrench;
use super::zones::ZONES;
use crate::creep::{CreepForces, Creepage};

/// State of a wheel on its rail, from harmless to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
#[non_exhaustive]
pub enum Status {
    /// No patch is loaded.
    #[default]
    Lifted,
    /// The wheel is loaded on tread, flange or both.
    Rolling,
    /// The flange is loaded beyond its steepest point: the wheel climbs.
    Climbing,
    /// The flange tip, or the wheel behind it, runs on the rail.
    PastTip,
    /// The pose is outside the tables (the forces are those of their nearest edge), or the penetration exceeds
    /// [`MAX_PENETRATION_M`](super::MAX_PENETRATION_M).
    OutsideTables,
    /// A number of the motion is NaN or greater than 1e9 in magnitude: the forces are zero.
    NotFinite,
}

/// Forces of the rail on one patch of the wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct PatchForces {
    /// Normal load, N.
    pub load_n: f64,
    /// Normal penetration, m.
    pub penetration_m: f64,
    /// Tangent of the contact angle against the track plane, positive on a cone that widens to the flange.
    pub slope: f64,
    /// Semi-axes `[a, b]` in the rolling direction and across, m.
    pub semi_axes_m: [f64; 2],
    /// Rolling radius, m.
    pub rolling_radius_m: f64,
    /// Lateral position on the wheel from the tread datum, field side positive, m.
    pub wheel_y_m: f64,
    /// Position from the wheelset's centre along x, y (right positive) and z, m.
    pub position_m: [f64; 3],
    /// Creepages in contact axes (see [`creep`](crate::creep)); the left wheel's are those of its mirror image.
    pub creepage: Creepage,
    /// Creep forces in the same axes.
    pub creep: CreepForces,
    /// Power dissipated by friction, W.
    pub dissipation_w: f64,
}

/// Forces of one rail on its wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WheelForces {
    /// The patch of each zone, from the flange to the field side; zeros where the zone is not loaded.
    pub patches: [PatchForces; ZONES],
    /// Force in track axes, N.
    pub force_n: [f64; 3],
    /// Moment about the wheelset's centre in track axes, N m.
    pub moment_n_m: [f64; 3],
    /// State of the wheel.
    pub status: Status,
}

/// Derivatives of the force and moment of one rail on its wheel: one row for each component along x, y and z, in it one
/// number for each field of [`Motion`](super::Motion) in the order of its declaration, in N and N m per unit of the field.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelDerivatives {
    /// Of the force.
    pub force: [[f64; MOTION_FIELDS]; 3],
    /// Of the moment about the wheelset's centre.
    pub moment: [[f64; MOTION_FIELDS]; 3],
}

/// Forces of both rails on a wheelset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WheelsetForces {
    /// The left wheel, then the right wheel.
    pub wheels: [WheelForces; 2],
    /// Force in track axes, N.
    pub force_n: [f64; 3],
    /// Moment about the centre in track axes, N m.
    pub moment_n_m: [f64; 3],
    /// The worse status of the two wheels.
    pub status: Status,
}

impl PatchForces {
    /// Contact angle against the track plane, rad; sign as `slope`.
    pub fn contact_angle_rad(&self) -> f64 {
        self.slope.atan()
    }
}

impl WheelsetForces {
    /// The forces where the profiles change along the track: `1 - share` of these and `share`, 0 to 1, of those by the profiles
    /// that follow. The patches and creepages are those of the greater share, the status is the worse one.
    pub fn blended(&self, next: &Self, share: f64) -> Self {
        let mut forces = if share < 0.5 { *self } else { *next };
        let blend = |from: [f64; 3], to: [f64; 3]| {
            std::array::from_fn(|k| (1.0 - share) * from[k] + share * to[k])
        };
        for (side, wheel) in forces.wheels.iter_mut().enumerate() {
            let (from, to) = (&self.wheels[side], &next.wheels[side]);
            wheel.force_n = blend(from.force_n, to.force_n);
            wheel.moment_n_m = blend(from.moment_n_m, to.moment_n_m);
            wheel.status = from.status.max(to.status);
        }
        forces.force_n = blend(self.force_n, next.force_n);
        forces.moment_n_m = blend(self.moment_n_m, next.moment_n_m);
        forces.status = self.status.max(next.status);
        forces
    }

    /// Derailment coefficients `Y/Q` of the left and the right wheel, dimensionless: positive when the rail pushes
    /// the wheel towards the track centre, zero for a lifted wheel.
    pub fn derailment_coefficients(&self) -> [f64; 2] {
        let coefficient = |wheel: &WheelForces, side: f64| {
            if wheel.force_n[2] < 0.0 {
                side * wheel.force_n[1] / wheel.force_n[2]
            } else {
                0.0
            }
        };
        [
            coefficient(&self.wheels[0], -1.0),
            coefficient(&self.wheels[1], 1.0),
        ]
    }
}

impl WheelForces {
    /// The patches that carry load.
    pub fn loaded_patches(&self) -> impl Iterator<Item = &PatchForces> {
        self.patches.iter().filter(|patch| patch.load_n > 0.0)
    }

    #[inline(always)]
    pub(super) fn set_wrench(&mut self, [fx, fy, fz, mx, my, mz]: Wrench<f64>) {
        self.force_n = [fx, fy, fz];
        self.moment_n_m = [mx, my, mz];
    }

    /// Turns the forces on the mirror image of a wheel into those on the wheel itself.
    #[inline(always)]
    pub(super) fn mirror(&mut self) {
        self.force_n[1] = -self.force_n[1];
        self.moment_n_m[0] = -self.moment_n_m[0];
        self.moment_n_m[2] = -self.moment_n_m[2];
        for patch in &mut self.patches {
            patch.position_m[1] = -patch.position_m[1];
        }
    }
}
