//! Derivatives of the creep forces.

use super::creepage::Creepage;
use super::forces::CreepForces;
use super::loaded_contact::LoadedContact;

/// Creep forces with their derivatives, for Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct CreepDerivatives {
    /// The forces.
    pub forces: CreepForces,
    /// Derivatives with respect to the creepages. Rows: longitudinal force, N, lateral force, N, and moment, N m.
    /// Columns: longitudinal creepage, lateral creepage, and spin, 1/m.
    pub by_creepage: [[f64; 3]; 3],
    /// Derivatives of the two forces and the moment with respect to the load, N/N and N m/N. The semi-axes grow as the
    /// cube root of the load (Hertz).
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
