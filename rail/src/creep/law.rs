//! The trait of creep laws, and the limits on the forces of every law.

use fearless_simd::{Simd, f64x4};

use super::contact_lanes::ContactLanes;
use super::creepage::Creepage;
use super::derivatives::CreepDerivatives;
use super::forces::CreepForces;
use super::loaded_contact::LoadedContact;
use crate::math::each::Each;
use crate::math::number::load;

/// A creep law: the tangential forces of a loaded contact as a function of the creepage.
///
/// ```
/// use dashpot_rail::creep::{CreepLaw, Creepage, KalkerTable, LoadedContact, ShenHedrickElkins};
/// let contact = LoadedContact {
///     load_n: 106.7e3,
///     a_m: 6.304e-3,
///     b_m: 12.61e-3,
///     shear_modulus_pa: 82e9,
///     kalker: KalkerTable::new(0.28)?.at(0.5),
///     friction: 0.33,
/// };
/// let braking = Creepage { longitudinal: 1.6e-3, ..Creepage::default() };
/// let forces = ShenHedrickElkins.forces(&contact, &braking);
/// // Exact theory gives 27.57 kN.
/// assert!((forces.longitudinal_n / -27.57e3 - 1.0).abs() < 0.05);
/// # Ok::<(), dashpot_rail::creep::KalkerError>(())
/// ```
pub trait CreepLaw: Send + Sync {
    /// Forces as the source of the law states them. The caller ensures positive load, semi-axes and friction, and a
    /// finite creepage.
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces;

    /// Dissipative forces within the friction limit; zero unless load, friction and semi-axes are positive and finite.
    fn forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        if !is_loaded(contact) {
            return CreepForces::default();
        }
        let creepage = creepage.bounded();
        passive(
            contact,
            &creepage,
            self.unlimited_forces(contact, &creepage),
        )
    }

    /// `[longitudinal force, lateral force, moment]` of four contacts, each lane as [`CreepLaw::forces`]; zero in lanes
    /// that are not `used`.
    ///
    /// The default evaluates the lanes one after the other. Override it only for speed.
    #[inline(always)]
    fn forces_in_lanes<S: Simd>(&self, contacts: &ContactLanes<S>, used: [bool; 4]) -> [f64x4<S>; 3]
    where
        Self: Sized,
    {
        forces_one_by_one(self, contacts, used)
    }

    /// [`CreepLaw::forces`] with their derivatives; the default uses central differences.
    fn forces_with_derivatives(
        &self,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> CreepDerivatives {
        differences(self, contact, creepage)
    }
}

impl<L: CreepLaw + ?Sized> CreepLaw for Box<L> {
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        self.as_ref().unlimited_forces(contact, creepage)
    }

    fn forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        self.as_ref().forces(contact, creepage)
    }

    fn forces_with_derivatives(
        &self,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> CreepDerivatives {
        self.as_ref().forces_with_derivatives(contact, creepage)
    }
}

/// Central differences of `law`, with steps of 1e-5 of the creepage at which linear theory reaches full sliding.
fn differences<L: CreepLaw + ?Sized>(
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

/// Evaluates the contacts in the lanes one after the other.
#[inline(always)]
pub(super) fn forces_one_by_one<L: CreepLaw + ?Sized, S: Simd>(
    law: &L,
    contacts: &ContactLanes<S>,
    used: [bool; 4],
) -> [f64x4<S>; 3] {
    let mut forces = [[0.0; 4]; 3];
    for lane in 0..4 {
        if used[lane] {
            let (contact, creepage) = contacts.in_lane(lane);
            for (sum, force) in forces
                .iter_mut()
                .zip(law.forces(&contact, &creepage).components())
            {
                sum[lane] = force;
            }
        }
    }
    forces.each(|lanes| load(contacts.load.simd, &lanes))
}

/// True if load, friction and semi-axes are positive and finite.
#[inline]
pub(super) fn is_loaded(contact: &LoadedContact) -> bool {
    let limit = contact.friction * contact.load_n;
    let area = contact.a_m * contact.b_m;
    // One factor of each product is checked as well, because two negative factors have a positive product.
    let loaded = contact.load_n > 0.0 && limit > 0.0 && limit.is_finite();
    loaded && contact.a_m > 0.0 && area > 0.0 && area.is_finite()
}

/// Forces of Kalker's linear theory, without friction limit.
///
/// `Fx = -G ab C11 xi`, `Fy = -G ab C22 eta - G (ab)^1.5 C23 phi`, `M = G (ab)^1.5 C23 eta - G (ab)^2 C33 phi`.
#[inline]
pub fn linear_forces(contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
    let area = contact.a_m * contact.b_m;
    let stiffness = contact.shear_modulus_pa * area;
    let mean_radius = area.sqrt();
    let k = &contact.kalker;
    CreepForces {
        longitudinal_n: -stiffness * k.c11 * creepage.longitudinal,
        lateral_n: -stiffness
            * (k.c22 * creepage.lateral + mean_radius * k.c23 * creepage.spin_per_m),
        moment_n_m: stiffness
            * mean_radius
            * (k.c23 * creepage.lateral - mean_radius * k.c33 * creepage.spin_per_m),
    }
}

/// Limits the force to friction, and the moment to that of full spin under Hertzian pressure (`(3 pi / 16) mu N r` for
/// a circle of radius `r`; here `r` is the major semi-axis). Then removes generated power, first from the moment, then
/// from the force in the sliding direction.
#[inline]
fn passive(contact: &LoadedContact, creepage: &Creepage, mut forces: CreepForces) -> CreepForces {
    let limit = contact.friction * contact.load_n;
    let square =
        forces.longitudinal_n * forces.longitudinal_n + forces.lateral_n * forces.lateral_n;
    if square > limit * limit {
        let factor = limit / square.sqrt();
        forces.longitudinal_n *= factor;
        forces.lateral_n *= factor;
    }
    let moment_limit = 3.0 * std::f64::consts::PI / 16.0 * limit * contact.a_m.max(contact.b_m);
    forces.moment_n_m = forces.moment_n_m.max(-moment_limit).min(moment_limit);
    let mut generated = -forces.dissipation_n(creepage);
    if generated > 0.0 && creepage.spin_per_m != 0.0 {
        forces.moment_n_m = (forces.moment_n_m - generated / creepage.spin_per_m)
            .max(-moment_limit)
            .min(moment_limit);
        generated = -forces.dissipation_n(creepage);
    }
    if generated > 0.0 {
        let square = creepage.longitudinal.powi(2) + creepage.lateral.powi(2);
        if square > 0.0 {
            forces.longitudinal_n -= generated * creepage.longitudinal / square;
            forces.lateral_n -= generated * creepage.lateral / square;
        }
    }
    forces
}
