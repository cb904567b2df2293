//! Properties shared by all patches of a wheelset: creep law, friction, elasticity and damping.

use fearless_simd::{Simd, f64x4};

use crate::creep::{Friction, FrictionError, KalkerLookup};
use crate::math::number::{Number, load};

/// Maximum normal damping, s/m; at an approach speed of 0.1 m/s it multiplies the elastic force by eleven.
pub const MAX_NORMAL_DAMPING_S_PER_M: f64 = 100.0;

/// Errors in the surface properties of a contact.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// The friction is out of bounds.
    #[error(transparent)]
    Friction(#[from] FrictionError),
    /// The normal damping is out of bounds.
    #[error(
        "normal damping: {normal_damping_s_per_m} s/m, allowed: 0 to {MAX_NORMAL_DAMPING_S_PER_M} s/m"
    )]
    NormalDamping {
        /// The damping, s/m.
        normal_damping_s_per_m: f64,
    },
}

/// Creep law, friction, elasticity and damping.
#[derive(Debug, Clone)]
pub(super) struct Surface<L> {
    pub law: L,
    pub friction: Friction,
    pub shear_modulus_pa: f64,
    pub kalker: KalkerLookup,
    pub normal_damping_s_per_m: f64,
}

impl<L> Surface<L> {
    /// Friction coefficients of four contacts.
    #[inline(always)]
    pub fn friction_in_lanes<S: Simd>(
        &self,
        [longitudinal, lateral, _]: [f64x4<S>; 3],
        reference_speed: f64x4<S>,
    ) -> f64x4<S> {
        let simd = reference_speed.simd;
        if self.friction.is_constant() {
            return simd.splat_f64x4(self.friction.static_coefficient);
        }
        let creepage = (longitudinal * longitudinal + lateral * lateral).sqrt();
        load(
            simd,
            &falling(&self.friction, (creepage * reference_speed).into()),
        )
    }

    /// Factor `1 + beta w` on the elastic load of surfaces that approach each other at speed `w` (Hunt and Crossley
    /// 1975). It is never negative, because rails cannot pull.
    #[inline(always)]
    pub fn damping<T: Number>(&self, approach_speed: T) -> T {
        (approach_speed * self.normal_damping_s_per_m + 1.0).not_negative()
    }
}

/// Not inlined, because the exponential would spill registers even if the friction is constant.
#[inline(never)]
fn falling(friction: &Friction, sliding_speed: [f64; 4]) -> [f64; 4] {
    sliding_speed.map(|speed| friction.at(speed))
}
