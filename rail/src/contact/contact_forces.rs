//! Creep forces of a loaded contact, with the derivatives of what they depend on.

use std::array::from_fn;

use super::surface::Surface;
use crate::creep::{
    CreepDerivatives, CreepForces, CreepLaw, Creepage, KalkerCoefficients, LoadedContact,
};
use crate::math::number::Number;

/// A loaded contact and its creepages.
pub(super) struct Contact<T> {
    /// Normal load, N.
    pub load: T,
    /// Semi-axes in the rolling direction and across, m.
    pub semi_axes: [T; 2],
    /// Kalker's `C11`, `C22`, `C23`, `C33`.
    pub kalker: [T; 4],
    /// Longitudinal and lateral creepage and spin.
    pub creepage: [T; 3],
}

/// The creep forces of a contact.
pub(super) struct Creep<T> {
    /// Longitudinal and lateral force, N, and spin moment, N m.
    pub forces: [T; 3],
    pub creepage: Creepage,
    pub creep: CreepForces,
}

impl<T: Number> Contact<T> {
    #[inline(always)]
    pub fn creep<L: CreepLaw>(&self, surface: &Surface<L>, reference_speed: T) -> Creep<T> {
        let [longitudinal, lateral, spin_per_m] = self.creepage.map(T::value);
        let creepage = Creepage {
            longitudinal,
            lateral,
            spin_per_m,
        }
        .bounded();
        let sliding_speed = creepage.magnitude() * reference_speed.value();
        let [c11, c22, c23, c33] = self.kalker.map(T::value);
        let contact = LoadedContact {
            load_n: self.load.value(),
            a_m: self.semi_axes[0].value(),
            b_m: self.semi_axes[1].value(),
            shear_modulus_pa: surface.shear_modulus_pa,
            kalker: KalkerCoefficients { c11, c22, c23, c33 },
            friction: surface.friction.at(sliding_speed),
        };
        let (forces, creep) = if T::DIFFERENTIATED {
            let (creep, derivatives) = surface.law.forces_with_derivatives(&contact, &creepage);
            let friction = self.friction(surface, &contact, sliding_speed, reference_speed);
            (self.differentiated(&creep, &derivatives, friction), creep)
        } else {
            let creep = surface.law.forces(&contact, &creepage);
            (components(&creep).map(T::constant), creep)
        };
        Creep {
            forces,
            creepage,
            creep,
        }
    }

    /// The friction coefficient, which falls with the sliding speed.
    fn friction<L>(
        &self,
        surface: &Surface<L>,
        contact: &LoadedContact,
        sliding_speed: f64,
        reference_speed: T,
    ) -> T {
        let slope = surface.friction.slope_at(sliding_speed);
        if slope == 0.0 || sliding_speed == 0.0 {
            return T::constant(contact.friction);
        }
        let [x, y, _] = self.creepage;
        let sliding = (x * x + y * y).sqrt() * reference_speed;
        T::function(contact.friction, [(slope, sliding)])
    }

    /// The forces as functions of all they depend on. Every law is `mu N f(x, y, z)` with
    /// `x = G ab C11 xi / (mu N)`, `y` and `z` likewise, and the moment has `sqrt(ab)` more: what changes the scale of a
    /// creepage acts on the force as the creepage itself does. (The explicit influence of `a/b` and `C33` is left out.)
    fn differentiated(
        &self,
        creep: &CreepForces,
        derivatives: &CreepDerivatives,
        friction: T,
    ) -> [T; 3] {
        let by = [
            components(&derivatives.by_longitudinal),
            components(&derivatives.by_lateral),
            components(&derivatives.by_spin),
        ];
        let creepage = self.creepage.map(T::value);
        let kalker = self.kalker.map(T::value);
        let limit = self.load * friction;
        let area = self.semi_axes[0] * self.semi_axes[1];
        let (per_limit, per_area) = (reciprocal(limit.value()), reciprocal(area.value()));
        let values = components(creep);
        from_fn(|k| {
            let slopes: [f64; 3] = from_fn(|c| by[c][k]);
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
                (scaled[0] * reciprocal(kalker[0]), self.kalker[0]),
                (scaled[1] * reciprocal(kalker[1]), self.kalker[1]),
                (scaled[2] * reciprocal(kalker[2]), self.kalker[2]),
            ];
            T::function(values[k], terms)
        })
    }
}

/// The reciprocal; zero for zero, where there is no load.
fn reciprocal(x: f64) -> f64 {
    if x > 0.0 { 1.0 / x } else { 0.0 }
}

#[inline(always)]
fn components(forces: &CreepForces) -> [f64; 3] {
    [
        forces.longitudinal_n,
        forces.lateral_n,
        forces.moment_n_m,
    ]
}
