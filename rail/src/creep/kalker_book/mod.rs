//! Exact theory of rolling contact, read from a book of tables.

mod coordinates;
mod pages;

use coordinates::{Coordinates, Scale, numbers};
pub use pages::Layout;
use pages::{Coefficient, Near, pages};

use super::creepage::Creepage;
use super::derivatives::CreepDerivatives;
use super::law::{CreepForces, CreepLaw, LoadedContact, is_loaded};
use crate::math::dual::Dual;
use crate::math::number::Number;

/// Kalker's exact theory of rolling contact from a precomputed book of tables (the idea of his USETAB, Vehicle System
/// Dynamics 27, 1997): the recommended law, with any spin.
///
/// The tables are those of the solver in `dashpot-reference` for Poisson's ratio 0.28, over `a/b` from 0.04 to 25 (beyond:
/// the tables at that ratio) and every creepage; small creepages give the linear theory with the contact's own
/// coefficients. The force has continuous derivatives by every creepage and never exceeds friction.
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
    pages: &'static [Coefficient],
}

impl KalkerBook {
    /// The book; its tables are read once in a process and shared.
    pub fn new() -> Self {
        Self { pages: pages() }
    }

    #[inline]
    fn near<R: Number>(&self, contact: &LoadedContact, at: &Coordinates<R>) -> Near<'static> {
        Near::new(
            self.pages,
            [contact.a_m, contact.b_m],
            [at.size, at.spin, at.direction].map(|coordinate| coordinate.lane(0)),
        )
    }
}

impl Default for KalkerBook {
    fn default() -> Self {
        Self::new()
    }
}

impl CreepLaw for KalkerBook {
    #[inline]
    fn unlimited_forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        let scale = Scale::new(contact);
        let at = Coordinates::new(contact, &scale, numbers(creepage));
        let [x, y, m, _] = self.near(contact, &at).value().to_array().map(f64::from);
        let [longitudinal_n, lateral_n, moment_n_m] = forces([x, y, m], &at, &scale);
        CreepForces {
            longitudinal_n,
            lateral_n,
            moment_n_m,
        }
    }

    /// The tables are within friction and dissipate energy.
    #[inline]
    fn forces(&self, contact: &LoadedContact, creepage: &Creepage) -> CreepForces {
        if is_loaded(contact) {
            self.unlimited_forces(contact, &creepage.bounded())
        } else {
            CreepForces::default()
        }
    }

    /// With exact derivatives.
    fn forces_with_derivatives(
        &self,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> CreepDerivatives {
        if !is_loaded(contact) {
            return CreepDerivatives::default();
        }
        let creepage = creepage.bounded();
        let numbers = numbers(&creepage);
        let scale = Scale::new(contact);
        let variables = [0, 1, 2].map(|k| Dual::<3>::variable(numbers[k], k));
        let at = Coordinates::new(contact, &scale, variables);
        let near = self.near(contact, &at);
        let value = near.value().to_array();
        let gradient = near.gradient().map(|slopes| slopes.to_array());
        let of_book = |k: usize| {
            let [size, spin, direction] = gradient.map(|slopes| f64::from(slopes[k]));
            let terms = [(size, at.size), (spin, at.spin), (direction, at.direction)];
            Dual::function(f64::from(value[k]), terms)
        };
        let forces = forces([0, 1, 2].map(of_book), &at, &scale);
        let [longitudinal_n, lateral_n, moment_n_m] = forces.map(|force| force.value());
        let values = CreepForces {
            longitudinal_n,
            lateral_n,
            moment_n_m,
        };
        let by_creepage = forces.map(|force| force.derivatives().map(f64::from));
        CreepDerivatives::new(values, by_creepage, contact, &creepage)
    }
}

/// Part of friction over which the force is bent to its limit.
const BEND: f64 = 0.005;

/// Forces in N and N m from the numbers of the book.
#[inline]
fn forces<R: Number>([x, y, moment]: [R; 3], at: &Coordinates<R>, scale: &Scale) -> [R; 3] {
    let per = (at.direction * at.direction + 1.0).reciprocal();
    let limited = limited((x * x + y * y) * per * per);
    let force = per * scale.force;
    let [along, across] = at.signs.map(|sign| force * sign);
    [
        x * along * limited,
        y * across * limited,
        moment * across * scale.moment_arm,
    ]
}

/// Factor that keeps a force with this square within 1, where the spline overshoots, and its slope continuous.
#[inline]
fn limited<R: Number>(square: R) -> R {
    if square.lane(0) <= (1.0 - BEND) * (1.0 - BEND) {
        return R::constant(1.0);
    }
    let force = square.sqrt();
    if force.lane(0) >= 1.0 + BEND {
        return force.reciprocal();
    }
    let beyond = force + (BEND - 1.0);
    (force - beyond * beyond * (0.25 / BEND)) / force
}
