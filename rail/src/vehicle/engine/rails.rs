//! Rails that give way: a mass on springs under each wheel.

use nalgebra::{DMatrix, DVector};

use super::block::{N, Vector};
use crate::contact::{RailDisplacement, WheelsetForces};
use crate::vehicle::error::VehicleError;

/// What carries a rail under a wheel: a mass that moves with the wheel along the track, on a spring and a dashpot each way.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RailSupport {
    /// Mass of rail and sleeper that moves, kg.
    pub mass_kg: f64,
    /// Stiffness to the side, N/m.
    pub lateral_stiffness_n_per_m: f64,
    /// Damping to the side, N s/m.
    pub lateral_damping_n_s_per_m: f64,
    /// Stiffness up and down, N/m.
    pub vertical_stiffness_n_per_m: f64,
    /// Damping up and down, N s/m.
    pub vertical_damping_n_s_per_m: f64,
}

/// Bounds of the mass, kg, of a stiffness, N/m, and of a damping, N s/m.
const MASS_KG: [f64; 2] = [1.0, 1e5];
const STIFFNESS: [f64; 2] = [1e5, 1e12];
const DAMPING: [f64; 2] = [0.0, 1e9];

/// Coordinates of the rails under a wheelset: lateral and vertical of the left one, then of the right one; the fifth rests.
const LATERAL: [usize; 2] = [0, 2];
const VERTICAL: [usize; 2] = [1, 3];

impl RailSupport {
    /// Checks every number.
    ///
    /// # Errors
    /// A mass not within 1 to 1e5 kg, a stiffness not within 1e5 to 1e12 N/m, a damping not within 0 to 1e9 N s/m.
    pub fn check(&self) -> Result<(), VehicleError> {
        for (name, value, allowed) in [
            ("mass_kg", self.mass_kg, MASS_KG),
            (
                "lateral_stiffness_n_per_m",
                self.lateral_stiffness_n_per_m,
                STIFFNESS,
            ),
            (
                "lateral_damping_n_s_per_m",
                self.lateral_damping_n_s_per_m,
                DAMPING,
            ),
            (
                "vertical_stiffness_n_per_m",
                self.vertical_stiffness_n_per_m,
                STIFFNESS,
            ),
            (
                "vertical_damping_n_s_per_m",
                self.vertical_damping_n_s_per_m,
                DAMPING,
            ),
        ] {
            VehicleError::check("rails", name, value, allowed)?;
        }
        Ok(())
    }

    /// Appends the rails of so many wheelsets to the equations of the bodies before them.
    pub(super) fn append(
        &self,
        wheelsets: usize,
        inertia: &mut DVector<f64>,
        stiffness: &mut DMatrix<f64>,
        damping: &mut DMatrix<f64>,
    ) {
        let first = inertia.len();
        let size = first + N * wheelsets;
        *inertia = inertia.clone().resize_vertically(size, 1.0);
        *stiffness = stiffness.clone().resize(size, size, 0.0);
        *damping = damping.clone().resize(size, size, 0.0);
        for rails in 0..wheelsets {
            for (coordinates, k, c) in [
                (
                    LATERAL,
                    self.lateral_stiffness_n_per_m,
                    self.lateral_damping_n_s_per_m,
                ),
                (
                    VERTICAL,
                    self.vertical_stiffness_n_per_m,
                    self.vertical_damping_n_s_per_m,
                ),
            ] {
                for coordinate in coordinates {
                    let place = first + N * rails + coordinate;
                    inertia[place] = self.mass_kg;
                    stiffness[(place, place)] = k;
                    damping[(place, place)] = c;
                }
            }
        }
    }
}

/// Adds where the rails have gone to what the track has of them.
#[inline(always)]
pub(super) fn displace(rails: &mut [RailDisplacement; 2], q: &Vector, v: &Vector) {
    for (side, rail) in rails.iter_mut().enumerate() {
        rail.lateral_m += q[LATERAL[side]];
        rail.vertical_m += q[VERTICAL[side]];
        rail.lateral_velocity_m_per_s += v[LATERAL[side]];
        rail.vertical_velocity_m_per_s += v[VERTICAL[side]];
    }
}

/// Forces of a wheelset on its rails, beyond those of the standing one.
#[inline(always)]
pub(super) fn push(contact: &WheelsetForces, standing_n: &Vector, forces: &mut Vector) {
    for (side, wheel) in contact.wheels.iter().enumerate() {
        let [_, y, z] = wheel.force_n;
        forces[LATERAL[side]] -= y + standing_n[LATERAL[side]];
        forces[VERTICAL[side]] -= z + standing_n[VERTICAL[side]];
    }
}

/// Forces of the standing wheelset on its rails, of those of the rails on its wheels, N.
pub(super) fn standing_n(wheel_forces_n: &[[f64; 3]; 2]) -> Vector {
    let mut standing = [0.0; N];
    for (side, [_, y, z]) in wheel_forces_n.iter().enumerate() {
        standing[LATERAL[side]] = -y;
        standing[VERTICAL[side]] = -z;
    }
    standing
}

/// How the rail on a side moves against a direction of the wheelset.
#[inline(always)]
pub(super) fn against(direction: &Vector, side: usize) -> Vector {
    let mut rails = [0.0; N];
    rails[LATERAL[side]] = -direction[0];
    rails[VERTICAL[side]] = -direction[1];
    rails
}
