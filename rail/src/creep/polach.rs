//! Polach's creep law.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};

use super::creepage::Creepage;
use super::forces::CreepForces;
use super::law::{CreepLaw, linear_forces};
use super::loaded_contact::LoadedContact;

/// Closed-form saturation with spin (Polach, A Fast Wheel-Rail Forces Calculation Computer Code,
/// Vehicle System Dynamics Supplement 33, 1999, 728-739).
///
/// `F = (2 mu N / pi) (e / (1 + e^2) + atan e)`, `e = G pi a b c s_c / (4 mu N)`, with `s_c = hypot(xi, eta_c)`, where
/// `eta_c` is the greater in magnitude of `eta` and `eta + phi a`. The lateral force caused by spin is
/// `9/16 a mu N K (1 + 6.3 (1 - exp(-a/b))) phi / s_c`.
///
/// **Not for contacts with spin** (flange, large contact angles). If the spin `phi sqrt(ab)` is half the sliding
/// creepage, the error of the force on the grid of docs/contact.md is 8 % of the friction limit (RMS), and at most 20
/// %. If the spin is twice that creepage, the RMS error is 14 % and the maximum 45 %. [`KalkerBook`](super::KalkerBook)
/// has no such limit.
///
/// The source states no moment. Here it is the moment of the linear theory, reduced by the same factor as the force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Polach;

impl CreepLaw for Polach {
    #[inline]
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let &LoadedContact {
            load_n: load,
            a_m: a,
            b_m: b,
            shear_modulus_pa: shear,
            kalker,
            friction,
        } = contact;
        let Creepage {
            longitudinal,
            lateral,
            spin_per_m: spin,
        } = *creepage;
        let limit = friction * load;
        let with_spin = lateral + spin * a;
        let modified_lateral = if with_spin.abs() > lateral.abs() {
            with_spin
        } else {
            lateral
        };
        let modified = (longitudinal * longitudinal + modified_lateral * modified_lateral).sqrt();
        if modified == 0.0 {
            return CreepForces::default();
        }
        // Divisions and roots are the slow operations of this law, so each is done once.
        let (per_limit, per_modified) = (1.0 / limit, 1.0 / modified);
        let (linear_x, linear_y) = (kalker.c11 * longitudinal, kalker.c22 * lateral);
        let creepage_square = longitudinal * longitudinal + lateral * lateral;
        let linear_square = linear_x * linear_x + linear_y * linear_y;
        // In pure spin `c` is not needed, because the force that it scales is zero.
        let c = if creepage_square > 0.0 {
            (linear_square / creepage_square).sqrt()
        } else {
            0.0
        };
        let e = FRAC_PI_4 * shear * a * b * c * modified * per_limit;
        let force = FRAC_2_PI * limit * (e / (1.0 + e * e) + libm::atan(e));
        let shape = 1.0 + 6.3 * (1.0 - libm::exp(-a / b));
        let stiffness = 8.0 / 3.0 * shear * b * (a * b).sqrt() * kalker.c23;
        let e_m = stiffness * modified_lateral.abs() * per_limit / shape;
        let reciprocal = 1.0 / (e_m * e_m + 1.0);
        let d = 1.0 - 2.0 * reciprocal;
        // (1 - d^2)^1.5
        let power = (2.0 * e_m * reciprocal).powi(3);
        let k_m = e_m * (d * d * (d * (1.0 / 3.0) - 0.5) + 1.0 / 6.0) - power * (1.0 / 3.0);
        // K is negative: positive spin causes a negative lateral force.
        let spin_force = 9.0 / 16.0 * a * limit * k_m * shape * spin * per_modified;
        let saturated = CreepForces {
            longitudinal_n: -force * longitudinal * per_modified,
            lateral_n: -force * lateral * per_modified + spin_force,
            moment_n_m: 0.0,
        };
        let linear = linear_forces(contact, creepage);
        let square =
            |f: &CreepForces| f.longitudinal_n * f.longitudinal_n + f.lateral_n * f.lateral_n;
        let (of_linear, of_saturated) = (square(&linear), square(&saturated));
        let factor = if of_linear > of_saturated {
            (of_saturated / of_linear).sqrt()
        } else {
            1.0
        };
        CreepForces {
            moment_n_m: linear.moment_n_m * factor,
            ..saturated
        }
    }
}
