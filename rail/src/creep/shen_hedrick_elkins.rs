//! The creep law of Shen, Hedrick and Elkins.

use super::creepage::Creepage;
use super::law::{CreepForces, CreepLaw, LoadedContact, linear_forces};

/// Kalker's linear forces, reduced by the cubic of Vermeulen and Johnson
/// `mu N (f - f^2/3 + f^3/27)` with `f = |F linear| / (mu N)` up to 3
/// (Shen, Hedrick, Elkins, Vehicle System Dynamics 12, 1983, 79-83).
///
/// **Not for contacts with much spin** (flange, large contact angles): with spin `phi sqrt(ab)` of half the sliding creepage
/// its force is off by 4 % of friction (RMS over the grid of docs/contact.md, 8 % at most), with twice that creepage by
/// 12 % (29 %). [`KalkerBook`](super::KalkerBook) has no such limit.
///
/// The moment is reduced by the same factor, so that the dissipation keeps the sign of the linear theory.
/// The force of full sliding is against `(C11 xi, C22 eta)`, not against the sliding itself.
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
