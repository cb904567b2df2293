//! The creep law of Shen, Hedrick and Elkins.

use super::creepage::{CreepForces, CreepLaw, Creepage, LoadedContact, linear};

/// Kalker's linear forces, shortened together by Vermeulen and Johnson's cubic
/// `mu N (f - f^2/3 + f^3/27)` with `f = |F linear| / (mu N)` up to 3
/// (Shen, Hedrick, Elkins, Vehicle System Dynamics 12, 1983, 79-83).
///
/// The moment shrinks by the same share, so the linear theory's dissipation keeps its sign.
/// Full sliding points along `(C11 xi, C22 eta)`, not along the sliding itself.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ShenHedrickElkins;

impl CreepLaw for ShenHedrickElkins {
    #[inline]
    fn raw(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let forces = linear(contact, creepage);
        let f = forces.magnitude() / (contact.friction * contact.load);
        let share = if f < 3.0 {
            1.0 + f * (f * (1.0 / 27.0) - 1.0 / 3.0)
        } else {
            1.0 / f
        };
        CreepForces {
            longitudinal: forces.longitudinal * share,
            lateral: forces.lateral * share,
            moment: forces.moment * share,
        }
    }
}
