//! Derivatives of the creep forces.

use super::creepage::Creepage;
use super::law::{CreepForces, CreepLaw, LoadedContact};

/// Forces with their derivatives, for Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CreepDerivatives {
    /// The forces.
    pub forces: CreepForces,
    /// Derivatives of longitudinal force, lateral force (N) and moment (N m), each by longitudinal creepage, lateral
    /// creepage and spin (1/m).
    pub by_creepage: [[f64; 3]; 3],
    /// Derivatives of the same three by the load, while the semi-axes grow as its cube root (Hertz): N/N and N m/N.
    pub by_load: [f64; 3],
}

impl CreepDerivatives {
    /// Of a law whose forces are `mu N` times a function of `G ab xi / (mu N)`, `G ab eta / (mu N)` and
    /// `G (ab)^1.5 phi / (mu N)`, as every law's are.
    #[inline]
    pub(super) fn new(
        forces: CreepForces,
        by_creepage: [[f64; 3]; 3],
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> Self {
        // With a^3 and b^3 as the load, xi and eta count as load^(-1/3) and spin does not count; the arm is load^(1/3).
        let values = forces.components();
        let by_load = |k: usize| {
            let [by_longitudinal, by_lateral, _] = by_creepage[k];
            let creepages = by_longitudinal * creepage.longitudinal + by_lateral * creepage.lateral;
            let exponent = if k == 2 { 4.0 / 3.0 } else { 1.0 };
            (exponent * values[k] - creepages / 3.0) / contact.load_n
        };
        Self {
            forces,
            by_creepage,
            by_load: [0, 1, 2].map(by_load),
        }
    }
}

/// Central differences of `law` over a hundred thousandth of the creepage at which linear theory slides.
pub(super) fn differences<L: CreepLaw + ?Sized>(
    law: &L,
    contact: &LoadedContact,
    creepage: &Creepage,
) -> CreepDerivatives {
    let forces = law.forces(contact, creepage);
    let area = contact.a_m * contact.b_m;
    let stiffness = contact.shear_modulus_pa * area * contact.kalker.c11;
    let sliding = contact.friction * contact.load_n / stiffness;
    if !(sliding > 0.0 && sliding.is_finite()) {
        return CreepDerivatives {
            forces,
            ..CreepDerivatives::default()
        };
    }
    let step = 1e-5 * sliding;
    let steps = [step, step, step / area.sqrt()];
    let mut by_creepage = [[0.0; 3]; 3];
    for (c, step) in steps.into_iter().enumerate() {
        let at = |step: f64| {
            let mut moved = *creepage;
            *[
                &mut moved.longitudinal,
                &mut moved.lateral,
                &mut moved.spin_per_m,
            ][c] += step;
            law.forces(contact, &moved).components()
        };
        let (before, after) = (at(-step), at(step));
        for k in 0..3 {
            by_creepage[k][c] = (after[k] - before[k]) / (2.0 * step);
        }
    }
    CreepDerivatives::new(forces, by_creepage, contact, creepage)
}
