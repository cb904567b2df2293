//! What the contact resists in one step: a symmetric estimate of its stiffness and damping from the patches themselves.

use fearless_simd::Simd;

use super::block::Weighted;
use super::rails::against;
use super::structure::Blocks;
use crate::contact::{PatchForces, WheelsetForces, ZONES};
use crate::creep::CreepForces;

/// Coefficient of Kalker that stands for both directions: 4 within a fourth for the ellipses of wheel and rail.
const KALKER: f64 = 4.0;

/// What the equations of a wheelset count of the contact's stiffness and damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    pub stiffness: f64,
    pub damping: f64,
}

/// What the surfaces of wheel and rail have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SurfaceConstants {
    pub shear_modulus_pa: f64,
    pub normal_damping_s_per_m: f64,
}

/// Blocks that a contact changes: of the wheelset, and of its rails, where they give way, with their coupling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ContactPlace {
    pub wheelset: usize,
    pub rails: Option<(usize, usize)>,
}

/// Adds the contact of a wheelset at `speed_m_per_s` to the blocks of its place.
///
/// - Along the normal the stiffness `3/2 N/penetration` of Hertz and the damping `beta N` of Hunt and Crossley.
/// - Across it the damping `f/speed` in both directions, `f` the force over the creepage, at most `4 G a b`.
///
/// A correction by these only has to be stable and small: what it leaves of the force is in the next step.
#[inline(always)]
pub(super) fn add_contact<S: Simd>(
    simd: S,
    system: &mut Blocks,
    place: &ContactPlace,
    forces: &WheelsetForces,
    surface: SurfaceConstants,
    speed_m_per_s: f64,
    weights: Weights,
) {
    for (number, wheel) in forces.wheels.iter().enumerate() {
        let side = if number == 0 { -1.0 } else { 1.0 };
        let mut all = [Weighted::NONE; 3 * ZONES];
        let mut on_rails = all;
        let mut places = all.iter_mut().zip(&mut on_rails);
        for patch in wheel.loaded_patches() {
            let stiffness = 1.5 * patch.load_n / patch.penetration_m.max(1e-9);
            let damping = creep_coefficient_n(patch, surface.shear_modulus_pa) / speed_m_per_s;
            let [x, y, z] = patch.position_m;
            // The left wheel's slope is that of its mirror image.
            let slope = -side * patch.slope;
            let cos = 1.0 / (1.0 + slope * slope).sqrt();
            let sin = slope * cos;
            // Lateral, vertical, roll, pitch, yaw; the place does not depend on the spin.
            let normal = [sin, -cos, -sin * z - cos * y, 0.0, sin * x];
            let across = [cos, sin, sin * y - cos * z, -sin * x, cos * x];
            let along = [0.0, 0.0, 0.0, z, -y];
            let normal_damping = patch.load_n * surface.normal_damping_s_per_m;
            let resistance = weights.stiffness * stiffness + weights.damping * normal_damping;
            let damping = weights.damping * damping;
            let three = [(normal, resistance), (across, damping), (along, damping)];
            for ((direction, weight), (of_wheelset, of_rails)) in three.into_iter().zip(&mut places)
            {
                *of_wheelset = Weighted::new(direction, weight);
                if place.rails.is_some() {
                    *of_rails = Weighted::new(against(&direction, number), weight);
                }
            }
        }
        let used = 3 * ZONES - places.len();
        system.diagonal[place.wheelset].add_along(simd, &all[..used]);
        if let Some((rails, coupling)) = place.rails {
            system.diagonal[rails].add_along(simd, &on_rails[..used]);
            system.couplings[coupling].add_between(simd, &on_rails[..used], &all[..used]);
        }
    }
}

/// Force over creepage, N.
#[inline(always)]
fn creep_coefficient_n(patch: &PatchForces, shear_modulus_pa: f64) -> f64 {
    let [a, b] = patch.semi_axes_m;
    let most = KALKER * shear_modulus_pa * a * b;
    let CreepForces {
        longitudinal_n,
        lateral_n,
        ..
    } = patch.creep;
    let force = magnitude(longitudinal_n, lateral_n);
    let creepage = magnitude(patch.creepage.longitudinal, patch.creepage.lateral);
    if force < most * creepage {
        force / creepage
    } else {
        most
    }
}

/// Of numbers whose squares neither overflow nor matter where they underflow.
#[inline(always)]
fn magnitude(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}
