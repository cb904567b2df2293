//! Results of the contact: forces on patches, wheels and the wheelset, and the state of each wheel.

use super::motion::{MOTION_FIELDS, Motion, RailDisplacement};
use super::zones::ZONES;
use crate::creep::{CreepForces, Creepage};

/// State of a wheel on its rail, from harmless to worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WheelForces {
    /// The patch of each zone, from the flange to the field side; zeros where the zone is not loaded.
    pub patches: [PatchForces; ZONES],
    /// Force in track axes, N.
    pub force_n: [f64; 3],
    /// Moment about the wheelset's centre in track axes, N m.
    pub moment_n_m: [f64; 3],
    /// State of the wheel.
    pub status: Status,
    /// A bit for each zone that carries load.
    pub(super) loaded_zones: u32,
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

/// Numbers told of a patch.
pub(super) const TOLD: usize = 17;

/// Place of the lateral position among them.
pub(super) const POSITION_Y: usize = 8;

impl PatchForces {
    /// Of the numbers in the order of the fields.
    #[inline(always)]
    pub(super) fn set(&mut self, told: [f64; TOLD]) {
        let [
            load,
            penetration,
            slope,
            a,
            b,
            radius,
            wheel_y,
            x,
            y,
            z,
            creep @ ..,
        ] = told;
        let [xi, eta, phi, longitudinal, lateral, moment, dissipation] = creep;
        *self = Self {
            load_n: load,
            penetration_m: penetration,
            slope,
            semi_axes_m: [a, b],
            rolling_radius_m: radius,
            wheel_y_m: wheel_y,
            position_m: [x, y, z],
            creepage: Creepage::of([xi, eta, phi]),
            creep: CreepForces::of_components([longitudinal, lateral, moment]),
            dissipation_w: dissipation,
        };
    }

    /// Contact angle against the track plane, rad; sign as `slope`.
    pub fn contact_angle_rad(&self) -> f64 {
        self.slope.atan()
    }
}

impl WheelsetForces {
    /// Whether the motion is one that forces can be computed of; otherwise they are zero and say so.
    #[inline(always)]
    pub(super) fn begin(&mut self, motion: &Motion, rails: &[RailDisplacement; 2]) -> bool {
        let accepted = motion.is_accepted() & rails[0].is_accepted() & rails[1].is_accepted();
        if !accepted {
            *self = Self::default();
            self.status = Status::NotFinite;
            for wheel in &mut self.wheels {
                wheel.status = Status::NotFinite;
            }
        }
        accepted
    }

    /// Sets force and moment of both wheels, of the left one on its mirror image, and adds them up.
    #[inline(always)]
    pub(super) fn set_wrenches(&mut self, wrench: [[f64; 2]; 6]) {
        const MIRRORED: [bool; 6] = [false, true, false, true, false, true];
        let [left_wheel, right_wheel] = &mut self.wheels;
        for (component, [left, right]) in wrench.into_iter().enumerate() {
            let left = if MIRRORED[component] { -left } else { left };
            let k = component % 3;
            let (of_left, of_right, sum) = if component < 3 {
                let (left, right) = (&mut left_wheel.force_n, &mut right_wheel.force_n);
                (left, right, &mut self.force_n)
            } else {
                let (left, right) = (&mut left_wheel.moment_n_m, &mut right_wheel.moment_n_m);
                (left, right, &mut self.moment_n_m)
            };
            (of_left[k], of_right[k], sum[k]) = (left, right, left + right);
        }
        self.status = left_wheel.status.max(right_wheel.status);
    }

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
}
