//! Results of the contact: forces on patches, wheels and the wheelset, and the state of each wheel.

use super::motion::{MOTION_FIELDS, Motion, RailDisplacement};
use super::status::Status;
use super::wheel::PatchOutput;
use super::wrench::Wrench;
use super::zones::ZONES;
use crate::creep::{CreepForces, Creepage};

/// Forces of the rail on one contact patch of the wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PatchForces {
    /// Normal load, N.
    pub load_n: f64,
    /// Normal penetration, m.
    pub penetration_m: f64,
    /// Tangent of the contact angle against the track plane; positive on a cone that widens towards the flange.
    pub slope: f64,
    /// Semi-axes `[a, b]` in the rolling direction and across, m.
    pub semi_axes_m: [f64; 2],
    /// Rolling radius, m.
    pub rolling_radius_m: f64,
    /// Lateral position on the wheel from the tread datum, field side positive, m.
    pub wheel_y_m: f64,
    /// Position relative to the wheelset's centre, along x, y (right positive) and z, m.
    pub position_m: [f64; 3],
    /// Creepages in contact axes (see [`creep`](crate::creep)); for the left wheel, those of its mirror image.
    pub creepage: Creepage,
    /// Creep forces, in the same axes as `creepage`.
    pub creep: CreepForces,
    /// Power dissipated by friction, W.
    pub dissipation_w: f64,
    /// Maximum normal pressure of the whole patch that this one is a part of, Pa.
    pub peak_pressure_pa: f64,
    /// Derivative of the elastic load with respect to a motion along the normal, N/m.
    pub stiffness_n_per_m: f64,
}

/// Forces of one rail on its wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WheelForces {
    /// The patch of each zone, from the flange to the field side; all zeros if the zone carries no load.
    pub patches: [PatchForces; ZONES],
    /// Force in track axes, N.
    pub force_n: [f64; 3],
    /// Moment about the wheelset's centre in track axes, N m.
    pub moment_n_m: [f64; 3],
    /// State of the wheel.
    pub status: Status,
    /// Bit mask of the zones that carry load.
    pub(super) loaded_zones: u32,
}

/// Derivatives of the force and moment of one rail on its wheel, in N and N m per unit of the variable.
///
/// Rows are the components along x, y and z. Columns are the fields of [`Motion`](super::Motion) in the order of their
/// declaration.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WheelDerivatives {
    /// Derivatives of the force.
    pub force: [[f64; MOTION_FIELDS]; 3],
    /// Derivatives of the moment about the wheelset's centre.
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

impl PatchForces {
    #[inline(always)]
    pub(super) fn set(&mut self, patch: PatchOutput<f64>) {
        *self = Self {
            load_n: patch.load,
            penetration_m: patch.penetration,
            slope: patch.slope,
            semi_axes_m: patch.semi_axes,
            rolling_radius_m: patch.rolling_radius,
            wheel_y_m: patch.wheel_y,
            position_m: patch.position,
            creepage: Creepage::of(patch.creepage),
            creep: CreepForces::of_components(patch.creep),
            dissipation_w: patch.dissipation,
            peak_pressure_pa: patch.peak_pressure,
            stiffness_n_per_m: patch.stiffness,
        };
    }

    /// Contact angle against the track plane, rad; it has the sign of `slope`.
    pub fn contact_angle_rad(&self) -> f64 {
        libm::atan(self.slope)
    }
}

impl WheelsetForces {
    /// Returns the power that creep dissipates on both wheels, W.
    #[inline]
    pub fn dissipation_w(&self) -> f64 {
        let patches = self.wheels.iter().flat_map(WheelForces::loaded_patches);
        patches.map(|patch| patch.dissipation_w).sum()
    }

    /// True if a wheel has two patches or more.
    #[inline(always)]
    pub(crate) fn has_second_patch(&self) -> bool {
        let [left, right] = &self.wheels;
        // With two bits or more, some are left when the lowest is removed.
        let without_lowest = |zones: u32| zones & zones.wrapping_sub(1);
        without_lowest(left.loaded_zones) | without_lowest(right.loaded_zones) != 0
    }

    /// Returns true if forces can be computed for the motion; otherwise sets them to zero and the status to
    /// `NotFinite`.
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

    /// Sets the force and moment of both wheels and their sums. `wrench` contains the wrench on the mirror image of the
    /// left wheel, then that on the right wheel.
    #[inline(always)]
    pub(super) fn set_wrenches(&mut self, wrench: Wrench<[f64; 2]>) {
        let [left_wheel, right_wheel] = &mut self.wheels;
        for k in 0..3 {
            let [left, right] = wrench.force[k];
            let left = if k == 1 { -left } else { left };
            (left_wheel.force_n[k], right_wheel.force_n[k]) = (left, right);
            self.force_n[k] = left + right;
        }
        for k in 0..3 {
            let [left, right] = wrench.moment[k];
            let left = if k == 1 { left } else { -left };
            (left_wheel.moment_n_m[k], right_wheel.moment_n_m[k]) = (left, right);
            self.moment_n_m[k] = left + right;
        }
        self.status = left_wheel.status.max(right_wheel.status);
    }

    /// Blends the forces of two profiles where the profiles change along the track: `1 - share` of these forces plus
    /// `share` (0 to 1) of `next`, the forces with the profiles ahead.
    ///
    /// Patches and creepages are taken from the profile with the greater share; the status is the worse of the two.
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

    /// Derailment coefficients `Y/Q` of the left and the right wheel, dimensionless; positive when the rail pushes the
    /// wheel towards the track centre, zero for a lifted wheel.
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
    /// Load `Q`, positive down on the rail, N.
    #[inline(always)]
    pub fn load_n(&self) -> f64 {
        0.0 - self.force_n[2] // not -0.0 for a lifted wheel
    }

    /// The patches that carry load.
    pub fn loaded_patches(&self) -> impl Iterator<Item = &PatchForces> {
        self.patches.iter().filter(|patch| patch.load_n > 0.0)
    }
}
