//! Creep forces of a loaded contact, by lane or with the derivatives of what they depend on.

use std::array::from_fn;

use super::motion::Tangent;
use super::surface::Surface;
use crate::creep::{
    CreepDerivatives, CreepForces, CreepLaw, Creepage, KalkerCoefficients, LoadedContact,
};
use crate::math::number::{Number, Sides};

/// A loaded contact and its creepages.
pub(super) struct Contact<T> {
    /// Normal load, N.
    pub load: T,
    /// Fraction of the load, and of the creep forces, that is asked for.
    pub fraction: T,
    /// Semi-axes in the rolling direction and across, m.
    pub semi_axes: [T; 2],
    /// Kalker's `C11`, `C22`, `C23`, `C33`.
    pub kalker: [T; 4],
    /// Longitudinal and lateral creepage and spin.
    pub creepage: [T; 3],
}

/// Creepage and creep forces in one lane.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Creep {
    pub creepage: Creepage,
    pub forces: CreepForces,
}

/// A number that a creep law can be evaluated with.
pub(super) trait CreepNumber: Number {
    /// Longitudinal and lateral force, N, and spin moment, N m; and what is told of them in each lane.
    fn creep<L: CreepLaw>(
        contact: &Contact<Self>,
        surface: &Surface<L>,
        reference_speed: Self,
    ) -> ([Self; 3], [Creep; 2]);
}

impl CreepNumber for Sides {
    #[inline(always)]
    fn creep<L: CreepLaw>(
        contact: &Contact<Self>,
        surface: &Surface<L>,
        reference_speed: Self,
    ) -> ([Self; 3], [Creep; 2]) {
        let creep = [0, 1].map(|lane| {
            let (loaded, creepage, _) = contact.in_lane(lane, surface, reference_speed);
            let forces = surface.law.forces(&loaded, &creepage);
            let forces = forces.scaled(contact.fraction.lane(lane));
            Creep { creepage, forces }
        });
        let [left, right] = creep.map(|creep| creep.forces.components());
        (from_fn(|k| Self::from([left[k], right[k]])), creep)
    }
}

impl CreepNumber for Tangent {
    #[inline(always)]
    fn creep<L: CreepLaw>(
        contact: &Contact<Self>,
        surface: &Surface<L>,
        reference_speed: Self,
    ) -> ([Self; 3], [Creep; 2]) {
        let (loaded, creepage, sliding_speed) = contact.in_lane(0, surface, reference_speed);
        let derivatives = surface.law.forces_with_derivatives(&loaded, &creepage);
        let friction_slope = surface.friction.slope_at(sliding_speed);
        let friction = if friction_slope == 0.0 || sliding_speed == 0.0 {
            Self::constant(loaded.friction)
        } else {
            let [x, y, _] = contact.creepage;
            let sliding = (x * x + y * y).sqrt() * reference_speed;
            Self::function(loaded.friction, [(friction_slope, sliding)])
        };
        (
            contact.differentiated(&derivatives, friction),
            [Creep {
                creepage,
                forces: derivatives.forces.scaled(contact.fraction.value()),
            }; 2],
        )
    }
}

impl<T: Number> Contact<T> {
    /// The contact in one lane as a creep law needs it, its creepages, and its sliding speed, m/s.
    #[inline(always)]
    fn in_lane<L>(
        &self,
        lane: usize,
        surface: &Surface<L>,
        reference_speed: T,
    ) -> (LoadedContact, Creepage, f64) {
        let [longitudinal, lateral, spin_per_m] = self.creepage.map(|number| number.lane(lane));
        let creepage = Creepage {
            longitudinal,
            lateral,
            spin_per_m,
        }
        .bounded();
        let sliding_speed = creepage.magnitude() * reference_speed.lane(lane);
        let [c11, c22, c23, c33] = self.kalker.map(|number| number.lane(lane));
        let loaded = LoadedContact {
            load_n: self.load.lane(lane),
            a_m: self.semi_axes[0].lane(lane),
            b_m: self.semi_axes[1].lane(lane),
            shear_modulus_pa: surface.shear_modulus_pa,
            kalker: KalkerCoefficients { c11, c22, c23, c33 },
            friction: surface.friction.at(sliding_speed),
        };
        (loaded, creepage, sliding_speed)
    }
}

impl Contact<Tangent> {
    /// The forces as functions of all they depend on. Every law is `mu N f(x, y, z)` with
    /// `x = G ab C11 xi / (mu N)`, `y` and `z` likewise, and the moment has `sqrt(ab)` more: what changes the scale of a
    /// creepage acts on the force as the creepage itself does. (The explicit influence of `a/b` and `C33` is left out.)
    fn differentiated(&self, derivatives: &CreepDerivatives, friction: Tangent) -> [Tangent; 3] {
        let creepage = self.creepage.map(|number| number.value());
        let kalker = self.kalker.map(|number| number.value());
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
                (scaled[0] * reciprocal(kalker[0]), self.kalker[0]),
                (scaled[1] * reciprocal(kalker[1]), self.kalker[1]),
                (scaled[2] * reciprocal(kalker[2]), self.kalker[2]),
            ];
            Tangent::function(values[k], terms) * self.fraction
        })
    }
}

/// The reciprocal; zero for zero, where there is no load.
fn reciprocal(x: f64) -> f64 {
    if x > 0.0 { 1.0 / x } else { 0.0 }
}
