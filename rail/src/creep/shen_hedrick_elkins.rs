//! The creep law of Shen, Hedrick and Elkins.

use super::creepage::Creepage;
use super::forces::CreepForces;
use super::law::{CreepLaw, linear_forces};
use super::loaded_contact::LoadedContact;

/// Kalker's linear forces, reduced by the cubic of Vermeulen and Johnson
/// `mu N (f - f^2/3 + f^3/27)`, where `f = |F linear| / (mu N)` is limited to 3
/// (Shen, Hedrick, Elkins, Vehicle System Dynamics 12, 1983, 79-83).
///
/// **Not for contacts with large spin** (flange, large contact angles). If the spin `phi sqrt(ab)` is half the sliding
/// creepage, the error of the force on the grid of docs/contact.md is 4 % of the friction limit (RMS), and at most 8 %.
/// If the spin is twice that creepage, the RMS error is 12 % and the maximum 29 %. [`KalkerBook`](super::KalkerBook)
/// has no such limit.
///
/// The moment is reduced by the same factor, so the dissipation keeps the sign of the linear theory.
/// In full sliding the force opposes `(C11 xi, C22 eta)`, not the sliding velocity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ShenHedrickElkins;

impl CreepLaw for ShenHedrickElkins {
    #[inline]
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let forces = linear_forces(contact, creepage);
        let f = forces.magnitude_n() / (contact.friction * contact.load_n);
        let factor = if f < 3.0 {
            1.0 + f * (f * (1.0 / 27.0) - 1.0 / 3.0)
        } else {
            1.0 / f
        };
        CreepForces {
            longitudinal_n: forces.longitudinal_n * factor,
            lateral_n: forces.lateral_n * factor,
            moment_n_m: forces.moment_n_m * factor,
        }
    }
}
