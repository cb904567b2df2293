//! Exact theory of rolling contact, interpolated from precomputed tables.

mod coordinates;
mod pages;

use std::ops::Mul;

use coordinates::{Contact, Coordinates, TINY, components};
use fearless_simd::{Level, Simd, SimdBase, f64x4};
pub use pages::Layout;
use pages::{BookPositions, Coefficients, pages};

use super::contact_lanes::ContactLanes;
use super::creepage::{Creepage, MAX_CREEPAGE};
use super::derivatives::CreepDerivatives;
use super::forces::CreepForces;
use super::law::{CreepLaw, forces_one_by_one, is_loaded};
use super::loaded_contact::LoadedContact;
use crate::math::dispatch::dispatch;
use crate::math::dual::Dual;
use crate::math::each::Each;
use crate::math::number::{Number, are_within, transposed};

/// Kalker's exact theory of rolling contact, from a precomputed book of tables. This is the recommended law, for any
/// spin.
///
/// The idea is that of Kalker's USETAB (Vehicle System Dynamics 27, 1997). The tables were computed with the solver in
/// `dashpot-reference` for Poisson's ratio 0.28. They cover all creepages, and `a/b` from 0.04 to 25; an `a/b` outside
/// this range is limited to it. For small creepages the result is the linear theory with the contact's own
/// coefficients. The force has continuous derivatives with respect to every creepage and never exceeds friction.
///
/// ```
/// use dashpot_rail::creep::{CreepLaw, Creepage, KalkerBook, KalkerTable, LoadedContact};
/// let contact = LoadedContact {
///     load_n: 106.7e3,
///     a_m: 6.304e-3,
///     b_m: 12.61e-3,
///     shear_modulus_pa: 82e9,
///     kalker: KalkerTable::new(0.28)?.at(0.5),
///     friction: 0.33,
/// };
/// let braking = Creepage { longitudinal: 1.6e-3, ..Creepage::default() };
/// let book = KalkerBook::new();
/// let forces = book.forces(&contact, &braking);
/// // An independent solver gives 27.57 kN.
/// assert!((forces.longitudinal_n / -27.57e3 - 1.0).abs() < 0.02);
/// // More braking adds force.
/// let derivatives = book.forces_with_derivatives(&contact, &braking);
/// assert!(derivatives.by_creepage[0][0] < 0.0);
/// # Ok::<(), dashpot_rail::creep::KalkerError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct KalkerBook {
    pages: &'static [Coefficients],
    level: Level,
}

impl KalkerBook {
    /// Opens the book. Its tables are decoded once per process and shared.
    pub fn new() -> Self {
        Self {
            pages: pages(),
            level: crate::math::level(),
        }
    }

    #[inline(always)]
    fn forces_in<S: Simd>(
        &self,
        simd: S,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> [f64; 3] {
        let contact = Contact::from_loaded(contact);
        let at = Coordinates::new(&contact, components(creepage));
        let positions = at.positions(simd, &contact);
        let [x, y, m, _] = positions.value(self.pages, 0).to_array();
        forces([x, y, m].map(f64::from), &at, &contact)
    }

    #[inline(always)]
    fn derivatives_in<S: Simd>(
        &self,
        simd: S,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> CreepDerivatives {
        let scaled = Contact::from_loaded(contact);
        let here = components(creepage);
        let beside = scaled.beside_pure_spin(here);
        let variables = [0, 1, 2].map(|k| Dual::<3>::variable(beside[k], k));
        let at = Coordinates::new(&scaled, variables);
        let positions = at.positions(simd, &scaled);
        let value = positions.value(self.pages, 0);
        let gradient = positions.gradient(self.pages, 0);
        let in_book = |k: usize| {
            let [size, spin, direction] = gradient.map(|slopes| f64::from(slopes[k]));
            // The direction runs from -1 to 1, the coordinate of the book from 0 to 1.
            let terms = [
                (size, at.size),
                (spin, at.spin),
                (0.5 * direction, at.direction),
            ];
            Dual::function(f64::from(value[k]), terms)
        };
        let forces = forces([0, 1, 2].map(in_book), &at, &scaled);
        let values = if beside == here {
            forces.map(|force| force.value())
        } else {
            self.forces_in(simd, contact, creepage)
        };
        let values = CreepForces::of_components(values);
        let by_creepage = forces.map(|force| force.derivatives().map(f64::from));
        CreepDerivatives::new(values, by_creepage, contact, creepage)
    }
}

impl Default for KalkerBook {
    fn default() -> Self {
        Self::new()
    }
}

impl CreepLaw for KalkerBook {
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let forces = dispatch!(self.level, simd => self.forces_in(simd, contact, creepage));
        CreepForces::of_components(forces)
    }

    /// The tabulated forces are dissipative and within the friction limit.
    fn forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        if is_loaded(contact) {
            self.unlimited_forces(contact, &creepage.bounded())
        } else {
            CreepForces::default()
        }
    }

    /// Evaluates all four contacts in parallel.
    #[inline(always)]
    fn forces_in_lanes<S: Simd>(
        &self,
        contacts: &ContactLanes<S>,
        used: [bool; 4],
    ) -> [f64x4<S>; 3] {
        let (contact, creepage) = (Contact::from_lanes(contacts), contacts.creepage);
        let [xi, eta, phi] = creepage;
        let square = xi * xi + eta * eta + phi * phi;
        let bounded = are_within(square, -1.0, MAX_CREEPAGE * MAX_CREEPAGE);
        if !(contact.are_loaded(contacts.load) & bounded) {
            // Passed by value, so that the contacts can stay in registers if this branch is not taken.
            return self.one_by_one(*contacts, used);
        }
        let simd = square.simd;
        let at = Coordinates::new(&contact, creepage);
        let direction = at.direction * 0.5 + 0.5;
        let coordinates = [contact.ratio, at.size, at.spin, direction];
        let positions = BookPositions::new(simd, coordinates);
        let mut values = [simd.splat_f32x4(0.0); 4];
        for lane in 0..4 {
            if used[lane] {
                values[lane] = positions.value(self.pages, lane);
            }
        }
        let [x, y, moment, _] = transposed(simd, values);
        forces([x, y, moment], &at, &contact)
    }

    /// The derivatives are exact.
    fn forces_with_derivatives(
        &self,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> CreepDerivatives {
        if !is_loaded(contact) {
            return CreepDerivatives::default();
        }
        let creepage = creepage.bounded();
        dispatch!(self.level, simd => self.derivatives_in(simd, contact, &creepage))
    }
}

impl KalkerBook {
    #[cold]
    #[inline(never)]
    fn one_by_one<S: Simd>(&self, contacts: ContactLanes<S>, used: [bool; 4]) -> [f64x4<S>; 3] {
        forces_one_by_one(self, &contacts, used)
    }
}

/// Fraction of the friction limit over which the force approaches the limit smoothly.
const BEND: f64 = 0.005;

/// Converts interpolated values of the book to forces, N, and moment, N m.
#[inline(always)]
fn forces<C: Number, R: Number + Mul<C, Output = R>>(
    [x, y, moment]: [R; 3],
    at: &Coordinates<R>,
    contact: &Contact<C>,
) -> [R; 3] {
    let per = (at.direction * at.direction + 1.0).reciprocal();
    let limited = limited((x * x + y * y) * per * per);
    let force = per * contact.force;
    let [along, across] = at.signs.each(|sign| force * sign);
    [
        x * along * limited,
        y * across * limited,
        moment * across * contact.moment_arm,
    ]
}

/// Factor that keeps a force within 1 where the spline overshoots; `square` is the square of the force. Above
/// `1 - BEND` the force follows a parabola with its vertex at 1, so its slope is continuous.
#[inline(always)]
fn limited<R: Number>(square: R) -> R {
    let force = (square + TINY).sqrt();
    let bent = force.limited(1.0 + BEND);
    let beyond = (bent + (BEND - 1.0)).not_negative();
    (bent - beyond * beyond * (0.25 / BEND)) / force
}
