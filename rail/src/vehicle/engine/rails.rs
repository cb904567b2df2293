//! Elastically supported rails: a mass on springs under each wheel.

use super::block::{N, Vector};
use crate::contact::{RailDisplacement, WheelsetForces};
use crate::vehicle::error::VehicleError;
use crate::vehicle::linear::Linear;

/// Elastic support of a rail under a wheel: a mass that moves along the track with the wheel, on a spring and a dashpot
/// in the lateral and in the vertical direction.
///
/// ```
/// use dashpot_rail::vehicle::RailSupport;
/// const SUPPORT: RailSupport = RailSupport::new(60.0)
///     .with_lateral(40e6, 60e3)
///     .with_vertical(80e6, 60e3);
/// assert!(SUPPORT.check().is_ok());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct RailSupport {
    /// Effective mass of rail and sleeper in lateral motion, kg.
    pub lateral_mass_kg: f64,
    /// Lateral stiffness, N/m.
    pub lateral_stiffness_n_per_m: f64,
    /// Lateral damping, N s/m.
    pub lateral_damping_n_s_per_m: f64,
    /// Effective mass of rail and sleeper in vertical motion, kg.
    pub vertical_mass_kg: f64,
    /// Vertical stiffness, N/m.
    pub vertical_stiffness_n_per_m: f64,
    /// Vertical damping, N s/m.
    pub vertical_damping_n_s_per_m: f64,
}

/// Bounds of the mass, kg.
const MASS_KG: [f64; 2] = [1.0, 1e5];
/// Bounds of a stiffness, N/m.
const STIFFNESS: [f64; 2] = [1e5, 1e12];
/// Bounds of a damping, N s/m.
const DAMPING: [f64; 2] = [0.0, 1e9];

/// Index of the lateral coordinate of the left and the right rail under a wheelset. The fifth coordinate is unused.
const LATERAL: [usize; 2] = [0, 2];
/// Index of the vertical coordinate of the left and the right rail.
const VERTICAL: [usize; 2] = [1, 3];

impl RailSupport {
    /// Ballasted main line track under a wheel of a locomotive.
    ///
    /// Vertical values and lateral stiffness and mass are those of British Rail's track for the force on a dipped joint
    /// and on a lateral ramp (GM/TT0088, Permissible track forces for railway vehicles, 1993). It has no lateral
    /// damping; here the lateral damping ratio equals the vertical one, 0.22.
    pub const BALLASTED: Self = Self::new(245.0)
        .with_vertical(62e6, 55.4e3)
        .with_lateral(25e6, 29e3)
        .with_lateral_mass(170.0);

    /// Returns a support with this effective mass in both directions, kg; its stiffnesses must be set, its dampings are
    /// zero.
    pub const fn new(mass_kg: f64) -> Self {
        Self {
            lateral_mass_kg: mass_kg,
            vertical_mass_kg: mass_kg,
            lateral_stiffness_n_per_m: 0.0,
            lateral_damping_n_s_per_m: 0.0,
            vertical_stiffness_n_per_m: 0.0,
            vertical_damping_n_s_per_m: 0.0,
        }
    }

    /// Sets lateral stiffness, N/m, and damping, N s/m.
    #[must_use]
    pub const fn with_lateral(mut self, stiffness_n_per_m: f64, damping_n_s_per_m: f64) -> Self {
        self.lateral_stiffness_n_per_m = stiffness_n_per_m;
        self.lateral_damping_n_s_per_m = damping_n_s_per_m;
        self
    }

    /// Sets the effective mass in lateral motion, kg.
    #[must_use]
    pub const fn with_lateral_mass(mut self, mass_kg: f64) -> Self {
        self.lateral_mass_kg = mass_kg;
        self
    }

    /// Sets vertical stiffness, N/m, and damping, N s/m.
    #[must_use]
    pub const fn with_vertical(mut self, stiffness_n_per_m: f64, damping_n_s_per_m: f64) -> Self {
        self.vertical_stiffness_n_per_m = stiffness_n_per_m;
        self.vertical_damping_n_s_per_m = damping_n_s_per_m;
        self
    }

    /// Checks the bounds of all values.
    ///
    /// # Errors
    /// A mass outside 1 to 1e5 kg, a stiffness outside 1e5 to 1e12 N/m, or a damping outside 0 to 1e9 N s/m.
    pub fn check(&self) -> Result<(), VehicleError> {
        let check = |name, value, allowed| VehicleError::check("rails", name, value, allowed);
        check("lateral_mass_kg", self.lateral_mass_kg, MASS_KG)?;
        check(
            "lateral_stiffness_n_per_m",
            self.lateral_stiffness_n_per_m,
            STIFFNESS,
        )?;
        check(
            "lateral_damping_n_s_per_m",
            self.lateral_damping_n_s_per_m,
            DAMPING,
        )?;
        check("vertical_mass_kg", self.vertical_mass_kg, MASS_KG)?;
        check(
            "vertical_stiffness_n_per_m",
            self.vertical_stiffness_n_per_m,
            STIFFNESS,
        )?;
        check(
            "vertical_damping_n_s_per_m",
            self.vertical_damping_n_s_per_m,
            DAMPING,
        )
    }

    /// Returns the smaller of the two masses, kg.
    pub(super) fn least_mass_kg(&self) -> f64 {
        self.lateral_mass_kg.min(self.vertical_mass_kg)
    }

    /// Appends the rails under `wheelsets` wheelsets to the equations of the bodies.
    pub(super) fn append(&self, wheelsets: usize, linear: &mut Linear) {
        let Linear {
            inertia,
            stiffness,
            damping,
            ..
        } = linear;
        let first = inertia.len();
        let size = first + N * wheelsets;
        *inertia = inertia.clone().resize_vertically(size, 1.0);
        *stiffness = stiffness.clone().resize(size, size, 0.0);
        *damping = damping.clone().resize(size, size, 0.0);
        for rails in 0..wheelsets {
            for (coordinates, m, k, c) in [
                (
                    LATERAL,
                    self.lateral_mass_kg,
                    self.lateral_stiffness_n_per_m,
                    self.lateral_damping_n_s_per_m,
                ),
                (
                    VERTICAL,
                    self.vertical_mass_kg,
                    self.vertical_stiffness_n_per_m,
                    self.vertical_damping_n_s_per_m,
                ),
            ] {
                for coordinate in coordinates {
                    let i = first + N * rails + coordinate;
                    inertia[i] = m;
                    stiffness[(i, i)] = k;
                    damping[(i, i)] = c;
                }
            }
        }
    }
}

/// Adds the motion `q`, `v` of the supported rails to their displacements from the track's irregularity.
#[inline(always)]
pub(super) fn displace(rails: &mut [RailDisplacement; 2], q: &Vector, v: &Vector) {
    for (side, rail) in rails.iter_mut().enumerate() {
        rail.lateral_m += q[LATERAL[side]];
        rail.vertical_m += q[VERTICAL[side]];
        rail.lateral_velocity_m_per_s += v[LATERAL[side]];
        rail.vertical_velocity_m_per_s += v[VERTICAL[side]];
    }
}

/// Adds the forces of a wheelset on its rails, in excess of those at standstill.
#[inline(always)]
pub(super) fn push(contact: &WheelsetForces, standing_n: &Vector, forces: &mut Vector) {
    for (side, wheel) in contact.wheels.iter().enumerate() {
        let [_, y, z] = wheel.force_n;
        forces[LATERAL[side]] -= y + standing_n[LATERAL[side]];
        forces[VERTICAL[side]] -= z + standing_n[VERTICAL[side]];
    }
}

/// Forces of the wheelset on its rails at standstill, N, from those of the rails on its wheels.
pub(super) fn standing_n(wheel_forces_n: &[[f64; 3]; 2]) -> Vector {
    let mut standing = [0.0; N];
    for (side, [_, y, z]) in wheel_forces_n.iter().enumerate() {
        standing[LATERAL[side]] = -y;
        standing[VERTICAL[side]] = -z;
    }
    standing
}

#[cfg(test)]
mod tests;
