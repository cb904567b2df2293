//! Polach's creep law.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};

use super::creepage::{CreepForces, CreepLaw, Creepage, LoadedContact, linear};

/// Closed-form saturation with spin (Polach, A Fast Wheel-Rail Forces Calculation Computer Code,
/// Vehicle System Dynamics Supplement 33, 1999, 728-739).
///
/// `F = 2 mu N / pi (e / (1 + e^2) + atan e)`, `e = G pi a b c s_c / (4 mu N)`, with
/// `s_c = hypot(xi, eta_c)` and `eta_c = eta + phi a` unless that is the lesser; the spin's own
/// lateral force is `9/16 a mu N K (1 + 6.3 (1 - exp(-a/b))) phi / s_c`.
/// The source gives no moment: the linear one, shortened like the force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Polach;

impl CreepLaw for Polach {
    #[inline]
    fn raw(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let &LoadedContact {
            load,
            a,
            b,
            shear,
            kalker,
            friction,
        } = contact;
        let Creepage {
            longitudinal,
            lateral,
            spin,
        } = *creepage;
        let limit = friction * load;
        let with_spin = lateral + spin * a;
        let across = if with_spin.abs() > lateral.abs() {
            with_spin
        } else {
            lateral
        };
        let modified = (longitudinal * longitudinal + across * across).sqrt();
        if modified == 0.0 {
            return CreepForces::default();
        }
        // Division and roots are the slow operations here: each once.
        let (per_limit, per_modified) = (1.0 / limit, 1.0 / modified);
        let (along, aside) = (kalker.c11 * longitudinal, kalker.c22 * lateral);
        let sliding = longitudinal * longitudinal + lateral * lateral;
        let pull = along * along + aside * aside;
        // Pure spin: the force it would scale has no direction.
        let c = if sliding > 0.0 {
            (pull / sliding).sqrt()
        } else {
            0.0
        };
        let e = FRAC_PI_4 * shear * a * b * c * modified * per_limit;
        let force = FRAC_2_PI * limit * (e / (1.0 + e * e) + e.atan());
        let shape = 1.0 + 6.3 * (1.0 - (-a / b).exp());
        let stiffness = 8.0 / 3.0 * shear * b * (a * b).sqrt() * kalker.c23;
        let e_m = stiffness * across.abs() * per_limit / shape;
        let share = 1.0 / (e_m * e_m + 1.0);
        let d = 1.0 - 2.0 * share;
        // (1 - d^2)^1.5
        let rest = (2.0 * e_m * share).powi(3);
        let k_m = e_m * (d * d * (d * (1.0 / 3.0) - 0.5) + 1.0 / 6.0) - rest * (1.0 / 3.0);
        // K is negative: the spin pushes against its own sense.
        let spin_force = 9.0 / 16.0 * a * limit * k_m * shape * spin * per_modified;
        let raw = CreepForces {
            longitudinal: -force * longitudinal * per_modified,
            lateral: -force * lateral * per_modified + spin_force,
            moment: 0.0,
        };
        let linear = linear(contact, creepage);
        let square = |f: &CreepForces| f.longitudinal * f.longitudinal + f.lateral * f.lateral;
        let (whole, part) = (square(&linear), square(&raw));
        let share = if whole > part {
            (part / whole).sqrt()
        } else {
            1.0
        };
        CreepForces {
            moment: linear.moment * share,
            ..raw
        }
    }
}
