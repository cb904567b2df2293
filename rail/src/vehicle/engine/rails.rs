//! Elastically supported rails: a mass on springs under each wheel.

use nalgebra::{DMatrix, DVector};

use super::block::{N, Vector};
use crate::contact::{RailDisplacement, WheelsetForces};
use crate::vehicle::error::VehicleError;

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
        for (name, value, allowed) in [
            ("lateral_mass_kg", self.lateral_mass_kg, MASS_KG),
            ("vertical_mass_kg", self.vertical_mass_kg, MASS_KG),
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

    /// Returns the smaller of the two masses, kg.
    pub(super) fn least_mass_kg(&self) -> f64 {
        self.lateral_mass_kg.min(self.vertical_mass_kg)
    }

    /// Appends the rails under `wheelsets` wheelsets to the equations of the bodies.
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
mod tests {
    use super::*;

    #[test]
    fn every_value_of_a_support_has_bounds() {
        let support = RailSupport::new(60.0)
            .with_lateral(40e6, 60e3)
            .with_vertical(80e6, 0.0);
        assert_eq!(support.check(), Ok(()));
        for (wrong, name) in [
            (
                RailSupport {
                    vertical_mass_kg: 0.5,
                    ..support
                },
                "vertical_mass_kg",
            ),
            (support.with_lateral_mass(2e5), "lateral_mass_kg"),
            (support.with_lateral(0.0, 0.0), "lateral_stiffness_n_per_m"),
            (
                support.with_lateral(40e6, -1.0),
                "lateral_damping_n_s_per_m",
            ),
            (
                support.with_vertical(2e12, 0.0),
                "vertical_stiffness_n_per_m",
            ),
            (
                support.with_vertical(80e6, f64::NAN),
                "vertical_damping_n_s_per_m",
            ),
        ] {
            let error = wrong.check().unwrap_err().to_string();
            assert!(error.starts_with(&format!("rails: {name} = ")), "{error}");
        }
    }

    #[test]
    fn a_rail_moves_in_addition_to_its_irregularity() {
        let irregularity = RailDisplacement {
            lateral_m: 1.0,
            vertical_m: 2.0,
            lateral_velocity_m_per_s: 3.0,
            vertical_velocity_m_per_s: 4.0,
            roll_rad: 5.0,
            roll_rate_rad_per_s: 6.0,
            yaw_rad: 8.0,
            friction_ratio: 0.7,
        };
        let mut rails = [irregularity; 2];
        let (q, v) = ([0.1, 0.2, 0.3, 0.4, 0.0], [0.5, 0.6, 0.7, 0.8, 0.0]);
        displace(&mut rails, &q, &v);
        for (rail, [y, z, vy, vz]) in rails
            .iter()
            .zip([[0.1, 0.2, 0.5, 0.6], [0.3, 0.4, 0.7, 0.8]])
        {
            let expected = RailDisplacement {
                lateral_m: 1.0 + y,
                vertical_m: 2.0 + z,
                lateral_velocity_m_per_s: 3.0 + vy,
                vertical_velocity_m_per_s: 4.0 + vz,
                ..irregularity
            };
            assert_eq!(*rail, expected);
        }
    }

    /// At standstill the supports carry the wheelset, so the rails stay where they are.
    #[test]
    fn only_a_change_of_the_wheel_forces_moves_the_rails() {
        let standing = [[100.0, 2e3, -50e3], [-100.0, -2.5e3, -51e3]];
        let mut contact = WheelsetForces::default();
        for (wheel, force_n) in contact.wheels.iter_mut().zip(standing) {
            wheel.force_n = force_n;
        }
        let mut forces = [0.0; N];
        push(&contact, &standing_n(&standing), &mut forces);
        assert_eq!(forces, [0.0; N]);
        // The right rail pushes its wheel harder to the left and upward.
        contact.wheels[1].force_n = [0.0, -3e3, -60e3];
        push(&contact, &standing_n(&standing), &mut forces);
        assert_eq!(forces, [0.0, 0.0, 500.0, 9e3, 0.0]);
    }

    #[test]
    fn rails_follow_the_bodies_in_the_equations() {
        let support = RailSupport::new(60.0)
            .with_lateral(2.0, 3.0)
            .with_lateral_mass(50.0)
            .with_vertical(4.0, 5.0);
        let bodies = 3 * N;
        let mut inertia = DVector::from_element(bodies, 7.0);
        let mut stiffness = DMatrix::from_element(bodies, bodies, 8.0);
        let mut damping = DMatrix::from_element(bodies, bodies, 9.0);
        support.append(2, &mut inertia, &mut stiffness, &mut damping);
        assert_eq!((inertia.len(), stiffness.shape()), (25, (25, 25)));
        for wheelset in 0..2 {
            let first = bodies + N * wheelset;
            let (lateral, vertical) = ([50.0, 2.0, 3.0], [60.0, 4.0, 5.0]);
            for (i, expected) in [lateral, vertical, lateral, vertical]
                .into_iter()
                .enumerate()
            {
                let at = (first + i, first + i);
                assert_eq!([inertia[first + i], stiffness[at], damping[at]], expected);
            }
            // The fifth coordinate has an inertia, so that the equations can be solved.
            let unused = first + 4;
            assert_eq!((inertia[unused], stiffness[(unused, unused)]), (1.0, 0.0));
        }
        assert!(stiffness.columns(bodies, N).rows(0, bodies).amax() == 0.0);
        assert_eq!(stiffness[(bodies - 1, bodies - 1)], 8.0);
    }
}
