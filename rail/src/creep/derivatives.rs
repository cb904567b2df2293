//! Derivatives of the creep forces.

use super::creepage::Creepage;
use super::law::{CreepForces, CreepLaw, LoadedContact};

/// Creep forces with their derivatives, for Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct CreepDerivatives {
    /// The forces.
    pub forces: CreepForces,
    /// Derivatives with respect to the creepages. Rows: longitudinal force, N, lateral force, N, and moment, N m.
    /// Columns: longitudinal creepage, lateral creepage, and spin, 1/m.
    pub by_creepage: [[f64; 3]; 3],
    /// Derivatives of the same three with respect to the load, N/N and N m/N; the semi-axes grow as its cube root
    /// (Hertz).
    pub by_load: [f64; 3],
}

impl CreepDerivatives {
    /// Adds the derivatives with respect to the load.
    ///
    /// The forces of every law are `mu N` times a function of `G ab xi / (mu N)`, `G ab eta / (mu N)` and
    /// `G (ab)^1.5 phi / (mu N)`.
    #[inline]
    pub(super) fn new(
        forces: CreepForces,
        by_creepage: [[f64; 3]; 3],
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> Self {
        // a^3 and b^3 are proportional to the load. The scaled xi and eta then vary as load^(-1/3), the scaled spin is
        // constant, and the lever arm of the moment varies as load^(1/3).
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

/// Central differences of `law`, with steps of 1e-5 of the creepage at which linear theory reaches full sliding.
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
