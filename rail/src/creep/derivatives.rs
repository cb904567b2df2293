//! Derivatives of the creep forces by the creepages.

use super::creepage::Creepage;
use super::law::{CreepForces, CreepLaw, LoadedContact};

/// Derivatives of the creep forces: each a force per unit of one creepage.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CreepDerivatives {
    /// By the longitudinal creepage, N and N m.
    pub by_longitudinal: CreepForces,
    /// By the lateral creepage, N and N m.
    pub by_lateral: CreepForces,
    /// By the spin, N m and N m^2.
    pub by_spin: CreepForces,
}

/// Central differences of `law` over a hundred thousandth of the creepage at which linear theory slides.
pub(super) fn differences<L: CreepLaw + ?Sized>(
    law: &L,
    contact: &LoadedContact,
    creepage: &Creepage,
) -> CreepDerivatives {
    let area = contact.a_m * contact.b_m;
    let stiffness = contact.shear_modulus_pa * area * contact.kalker.c11;
    let sliding = contact.friction * contact.load_n / stiffness;
    if !(sliding > 0.0 && sliding.is_finite()) {
        return CreepDerivatives::default();
    }
    let step = 1e-5 * sliding;
    let by = |step: f64, change: fn(&mut Creepage) -> &mut f64| {
        let at = |step: f64| {
            let mut moved = *creepage;
            *change(&mut moved) += step;
            law.forces(contact, &moved)
        };
        let (before, after) = (at(-step), at(step));
        let slope = |from: f64, to: f64| (to - from) / (2.0 * step);
        CreepForces {
            longitudinal_n: slope(before.longitudinal_n, after.longitudinal_n),
            lateral_n: slope(before.lateral_n, after.lateral_n),
            moment_n_m: slope(before.moment_n_m, after.moment_n_m),
        }
    };
    CreepDerivatives {
        by_longitudinal: by(step, |creepage| &mut creepage.longitudinal),
        by_lateral: by(step, |creepage| &mut creepage.lateral),
        by_spin: by(step / area.sqrt(), |creepage| &mut creepage.spin_per_m),
    }
}
