//! Symmetric estimate of the contact's stiffness and damping for one step.

use fearless_simd::Simd;

use super::block::Block;
use super::columns::Products;
use super::rail_equations::RailEquations;
use crate::contact::{PatchForces, WheelsetForces};
use crate::creep::CreepForces;

/// Kalker's coefficient for both directions: at most this for the contact ellipses of wheel and rail, and at least 3.
pub(super) const KALKER: f64 = 5.0;

/// Weights of the contact's stiffness and damping in the equations of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weights {
    pub stiffness: f64,
    pub damping: f64,
}

/// Material constants of the contact of wheel and rail.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SurfaceConstants {
    pub shear_modulus_pa: f64,
    pub normal_damping_s_per_m: f64,
}

/// Adds the contact of a wheelset at `speed_m_per_s` to its block and to the equations of its rails, if they are
/// elastically supported.
///
/// - Normal direction: the stiffness of the patch and the damping `beta N` of Hunt and Crossley.
/// - Both tangential directions: the damping `f/speed`, where `f` is the force divided by the creepage, limited to
///   `5 G a b`.
///
/// An estimate is sufficient if it keeps the correction stable and small: the next step corrects the remaining force
/// error.
#[inline(always)]
pub(super) fn add_contact<S: Simd>(
    simd: S,
    wheelset: &mut Block,
    mut rails: Option<&mut RailEquations>,
    forces: &WheelsetForces,
    surface: SurfaceConstants,
    speed_m_per_s: f64,
    weights: Weights,
) {
    let mut products = Products::new(simd, wheelset);
    for (number, wheel) in forces.wheels.iter().enumerate() {
        let side = if number == 0 { -1.0 } else { 1.0 };
        for patch in wheel.loaded_patches() {
            let stiffness = patch.stiffness_n_per_m;
            let damping = creep_coefficient_n(patch, surface.shear_modulus_pa) / speed_m_per_s;
            let [x, y, z] = patch.position_m;
            // The slope of the left wheel is given in mirrored axes.
            let slope = -side * patch.slope;
            let cos = 1.0 / (1.0 + slope * slope).sqrt();
            let sin = slope * cos;
            // Lateral, vertical, roll, pitch, yaw. The position of the patch does not depend on the spin.
            let normal = [sin, -cos, -sin * z - cos * y, 0.0, sin * x];
            let across = [cos, sin, sin * y - cos * z, -sin * x, cos * x];
            let along = [0.0, 0.0, 0.0, z, -y];
            let normal_damping = patch.load_n * surface.normal_damping_s_per_m;
            let resistance = weights.stiffness * stiffness + weights.damping * normal_damping;
            let damping = weights.damping * damping;
            let weighted = products.add(&normal, resistance, [0, 1, 2, 4]);
            let weighted_across = products.add(&across, damping, [0, 1, 2, 3, 4]);
            products.add(&along, damping, [3, 4]);
            if let Some(rails) = rails.as_deref_mut() {
                rails.add(simd, number, [sin, -cos], &weighted);
                rails.add(simd, number, [cos, sin], &weighted_across);
            }
        }
    }
    products.write(wheelset);
}

/// Force divided by creepage, N.
#[inline(always)]
fn creep_coefficient_n(patch: &PatchForces, shear_modulus_pa: f64) -> f64 {
    let [a, b] = patch.semi_axes_m;
    let max = KALKER * shear_modulus_pa * a * b;
    let CreepForces {
        longitudinal_n,
        lateral_n,
        ..
    } = patch.creep;
    let force = magnitude(longitudinal_n, lateral_n);
    let creepage = magnitude(patch.creepage.longitudinal, patch.creepage.lateral);
    if force < max * creepage {
        force / creepage
    } else {
        max
    }
}

/// Length of a vector. The squares of its components do not overflow, but may underflow.
#[inline(always)]
fn magnitude(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests;
