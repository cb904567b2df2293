//! Creep forces of a loaded contact, in vector lanes or with derivatives.

use std::array::from_fn;

use fearless_simd::{Simd, f64x4};

use super::motion::Tangent;
use super::surface::Surface;
use crate::creep::{
    ContactLanes, CreepDerivatives, CreepLaw, Creepage, KalkerCoefficients, KalkerLookup,
    LoadedContact,
};
use crate::math::each::Each;
use crate::math::number::Number;

/// A loaded contact and its creepages.
pub(super) struct Contact<T> {
    /// Normal load, N.
    pub load: T,
    /// Fraction of the load and of the creep forces that belongs to the patch.
    pub fraction: T,
    /// Semi-axes in the rolling direction and across, m.
    pub semi_axes: [T; 2],
    pub kalker: KalkerCoefficients<T>,
    /// Longitudinal creepage, lateral creepage, and spin, 1/m.
    pub creepage: [T; 3],
    /// Factor on the friction coefficient of the surface.
    pub friction_ratio: T,
}

/// A number type for which creep laws can be evaluated.
pub(super) trait CreepNumber: Number {
    /// Longitudinal force, N, lateral force, N, and spin moment, N m, in the lanes that are `used`.
    fn creep_forces<L: CreepLaw>(
        contact: &Contact<Self>,
        surface: &Surface<L>,
        reference_speed: Self,
        used: [bool; 4],
    ) -> [Self; 3];

    /// Kalker's coefficients of an ellipse.
    fn kalker(lookup: &KalkerLookup, semi_axes: [Self; 2]) -> KalkerCoefficients<Self>;
}

impl<S: Simd> CreepNumber for f64x4<S> {
    #[inline(always)]
    fn creep_forces<L: CreepLaw>(
        contact: &Contact<Self>,
        surface: &Surface<L>,
        reference_speed: Self,
        used: [bool; 4],
    ) -> [Self; 3] {
        let contacts = ContactLanes {
            load: contact.load,
            semi_axes: contact.semi_axes,
            shear_modulus: surface.shear_modulus_pa,
            kalker: contact.kalker,
            friction: surface.friction_in_lanes(contact.creepage, reference_speed)
                * contact.friction_ratio,
            creepage: contact.creepage,
        };
        let forces = surface.law.forces_in_lanes(&contacts, used);
        forces.each(|force| force * contact.fraction)
    }

    #[inline(always)]
    fn kalker(lookup: &KalkerLookup, semi_axes: [Self; 2]) -> KalkerCoefficients<Self> {
        lookup.at_lanes(semi_axes)
    }
}

impl CreepNumber for Tangent {
    #[inline(always)]
    fn creep_forces<L: CreepLaw>(
        contact: &Contact<Self>,
        surface: &Surface<L>,
        reference_speed: Self,
        _: [bool; 4],
    ) -> [Self; 3] {
        let creepage = Creepage::of(contact.creepage.map(|number| number.value()));
        let sliding_speed = creepage.magnitude() * reference_speed.value();
        let KalkerCoefficients { c11, c22, c23, c33 } = contact.kalker;
        // The ratio depends on the rail, not on the motion.
        let ratio = contact.friction_ratio.value();
        let loaded = LoadedContact {
            load_n: contact.load.value(),
            a_m: contact.semi_axes[0].value(),
            b_m: contact.semi_axes[1].value(),
            shear_modulus_pa: surface.shear_modulus_pa,
            kalker: KalkerCoefficients {
                c11: c11.value(),
                c22: c22.value(),
                c23: c23.value(),
                c33: c33.value(),
            },
            friction: surface.friction.at(sliding_speed) * ratio,
        };
        let derivatives = surface.law.forces_with_derivatives(&loaded, &creepage);
        let friction_slope = surface.friction.slope_at(sliding_speed) * ratio;
        let friction = if friction_slope == 0.0 || sliding_speed == 0.0 {
            Self::constant(loaded.friction)
        } else {
            let [x, y, _] = contact.creepage;
            let sliding = (x * x + y * y).sqrt() * reference_speed;
            Self::function(loaded.friction, [(friction_slope, sliding)])
        };
        contact.differentiated(&derivatives, friction)
    }

    fn kalker(lookup: &KalkerLookup, semi_axes: [Self; 2]) -> KalkerCoefficients<Self> {
        lookup.at_dual(semi_axes)
    }
}

impl Contact<Tangent> {
    /// Differentiates the forces with respect to everything they depend on.
    ///
    /// Every law is `mu N f(x, y, z)` with `x = G ab C11 xi / (mu N)`, similarly `y` and `z`, and for the moment a
    /// further factor `sqrt(ab)`. A change of the scale of a creepage therefore acts on the force like a change of the
    /// creepage itself. The explicit influence of `a/b` and `C33` is neglected.
    fn differentiated(&self, derivatives: &CreepDerivatives, friction: Tangent) -> [Tangent; 3] {
        let creepage = self.creepage.map(|number| number.value());
        // The coefficient that scales each creepage.
        let scales = [self.kalker.c11, self.kalker.c22, self.kalker.c23];
        let limit = self.load * friction;
        let area = self.semi_axes[0] * self.semi_axes[1];
        let (per_limit, per_area) = (reciprocal(limit.value()), reciprocal(area.value()));
        let values = derivatives.forces.components();
        from_fn(|k| {
            let slopes = derivatives.by_creepage[k];
            let scaled: [f64; 3] = from_fn(|c| slopes[c] * creepage[c]);
            let in_moment = if k == 2 { 0.5 * values[2] } else { 0.0 };
            let by_limit = (values[k] - scaled[0] - scaled[1] - scaled[2]) * per_limit;
            let by_area = (scaled[0] + scaled[1] + 1.5 * scaled[2] + in_moment) * per_area;
            let terms = [
                (by_limit, limit),
                (by_area, area),
                (slopes[0], self.creepage[0]),
                (slopes[1], self.creepage[1]),
                (slopes[2], self.creepage[2]),
                (scaled[0] * reciprocal(scales[0].value()), scales[0]),
                (scaled[1] * reciprocal(scales[1].value()), scales[1]),
                (scaled[2] * reciprocal(scales[2].value()), scales[2]),
            ];
            Tangent::function(values[k], terms) * self.fraction
        })
    }
}

/// The reciprocal of `x`; zero if `x` is zero, as without load.
fn reciprocal(x: f64) -> f64 {
    if x > 0.0 { 1.0 / x } else { 0.0 }
}
