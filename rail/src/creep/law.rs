//! The trait of creep laws, and the limits on the forces of every law.

use fearless_simd::{Simd, f64x4};

use super::contact_lanes::ContactLanes;
use super::creepage::Creepage;
use super::derivatives::{CreepDerivatives, differences};
use super::kalker::KalkerCoefficients;
use crate::math::each::Each;
use crate::math::number::load;

/// One loaded contact, the input of creep laws.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedContact {
    /// Normal load, N.
    pub load_n: f64,
    /// Semi-axis in the rolling direction, m.
    pub a_m: f64,
    /// Semi-axis across, m.
    pub b_m: f64,
    /// Shear modulus, Pa.
    pub shear_modulus_pa: f64,
    /// Kalker's coefficients of the ellipse.
    pub kalker: KalkerCoefficients,
    /// Friction coefficient at the contact's sliding speed, dimensionless.
    pub friction: f64,
}

/// Creep forces on the wheel, in [contact axes](crate::creep).
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CreepForces {
    /// Force in the rolling direction, N.
    pub longitudinal_n: f64,
    /// Force along the common tangent to the field side, N.
    pub lateral_n: f64,
    /// Spin moment about axis 3, N m.
    pub moment_n_m: f64,
}

impl CreepForces {
    /// Returns `[longitudinal force, lateral force, moment]`, N and N m.
    #[inline]
    pub fn components(&self) -> [f64; 3] {
        [self.longitudinal_n, self.lateral_n, self.moment_n_m]
    }

    /// Forces with components `[longitudinal force, lateral force, moment]`, N and N m.
    #[inline(always)]
    pub(crate) fn of_components([longitudinal_n, lateral_n, moment_n_m]: [f64; 3]) -> Self {
        Self {
            longitudinal_n,
            lateral_n,
            moment_n_m,
        }
    }

    /// Multiplies forces and moment by `factor`.
    #[inline]
    pub fn scaled(&self, factor: f64) -> Self {
        Self::of_components(self.components().map(|component| component * factor))
    }

    /// Magnitude of the tangential force, N.
    pub fn magnitude_n(&self) -> f64 {
        (self.longitudinal_n * self.longitudinal_n + self.lateral_n * self.lateral_n).sqrt()
    }

    /// Dissipated power divided by the speed, N: `-(Fx xi + Fy eta + M phi)`; positive if energy is dissipated.
    pub fn dissipation_n(&self, creepage: &Creepage) -> f64 {
        -(self.longitudinal_n * creepage.longitudinal
            + self.lateral_n * creepage.lateral
            + self.moment_n_m * creepage.spin_per_m)
    }
}

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

/// Limits the force to friction, and the moment to that of full spin under Hertzian pressure (`3 pi / 16 mu N r` for a
/// circle of radius `r`, here the major semi-axis). Then removes generated power, first from the moment, then from the
/// force in the sliding direction.
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
