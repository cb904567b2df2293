//! Exact theory of rolling contact, read from a book of tables.

mod coordinates;
mod pages;

use coordinates::{Coordinates, Scale, numbers};
pub use pages::Layout;
use pages::{Coefficient, Near, pages};

use super::creepage::Creepage;
use super::law::{CreepForces, CreepLaw, LoadedContact, is_loaded};
use crate::math::dual::{Dual, Real};

/// Kalker's exact theory of rolling contact from a precomputed book of tables (the idea of his USETAB, Vehicle System
/// Dynamics 27, 1997): the recommended law, with any spin.
///
/// The tables are those of the solver in `dashpot-reference` for Poisson's ratio 0.28, over `a/b` from 0.1 to 10 (beyond:
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

/// Forces with their derivatives, for Newton's method.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CreepDerivatives {
    /// The forces.
    pub forces: CreepForces,
    /// Derivatives of longitudinal force, lateral force (N) and moment (N m), each by longitudinal creepage, lateral
    /// creepage and spin (1/m).
    pub by_creepage: [[f64; 3]; 3],
    /// Derivatives of the same three by the load, while the semi-axes grow as its cube root (Hertz): N/N and N m/N.
    pub by_load: [f64; 3],
}

impl KalkerBook {
    /// The book; its tables are read once in a process and shared.
    pub fn new() -> Self {
        Self { pages: pages() }
    }

    /// [`CreepLaw::forces`] with their exact derivatives; all zero for a contact without load.
    pub fn forces_with_derivatives(
        &self,
        contact: &LoadedContact,
        creepage: &Creepage,
    ) -> CreepDerivatives {
        if !is_loaded(contact) {
            return CreepDerivatives::default();
        }
        let numbers = numbers(&creepage.bounded());
        let scale = Scale::new(contact);
        let variables = [0, 1, 2].map(|k| Dual::variable(numbers[k], k));
        let at = Coordinates::new(contact, &scale, variables);
        let near = self.near(contact, &at);
        let value = near.value().to_array();
        let gradient = near.gradient().map(|slopes| slopes.to_array());
        let of_book = |k: usize| {
            let [size, spin, direction] = [0, 1, 2].map(|axis| f64::from(gradient[axis][k]));
            Dual {
                value: f64::from(value[k]),
                by: [0, 1, 2].map(|c| {
                    size * at.size.by[c] + spin * at.spin.by[c] + direction * at.direction.by[c]
                }),
            }
        };
        let forces = forces([0, 1, 2].map(of_book), &at, &scale);
        let [x, y, m] = forces.map(|force| force.value);
        // With a^3 and b^3 as the load, xi and eta count as load^(-1/3) and spin does not count; the arm is load^(1/3).
        let by_load = |k: usize| {
            let creepages = forces[k].by[0] * numbers[0] + forces[k].by[1] * numbers[1];
            let exponent = if k == 2 { 4.0 / 3.0 } else { 1.0 };
            (exponent * forces[k].value - creepages / 3.0) / contact.load_n
        };
        CreepDerivatives {
            forces: CreepForces {
                longitudinal_n: x,
                lateral_n: y,
                moment_n_m: m,
            },
            by_creepage: forces.map(|force| force.by),
            by_load: [0, 1, 2].map(by_load),
        }
    }

    #[inline]
    fn near<R: Real>(&self, contact: &LoadedContact, at: &Coordinates<R>) -> Near<'static> {
        Near::new(
            self.pages,
            [contact.a_m, contact.b_m],
            [at.size, at.spin, at.direction].map(R::value),
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
}

/// Part of friction over which the force is bent to its limit.
const BEND: f64 = 0.005;

/// Forces in N and N m from the numbers of the book.
#[inline]
fn forces<R: Real>([x, y, moment]: [R; 3], at: &Coordinates<R>, scale: &Scale) -> [R; 3] {
    let one = R::from(1.0);
    let per = one / (one + at.direction * at.direction);
    let limited = limited((x * x + y * y) * per * per);
    let force = R::from(scale.force) * per;
    let [along, across] = at.signs.map(|sign| force * R::from(sign));
    [
        x * along * limited,
        y * across * limited,
        moment * across * R::from(scale.moment_arm),
    ]
}

/// Factor that keeps a force with this square within 1, where the spline overshoots, and its slope continuous.
#[inline]
fn limited<R: Real>(square: R) -> R {
    if square.value() <= (1.0 - BEND) * (1.0 - BEND) {
        return R::from(1.0);
    }
    let force = square.sqrt();
    if force.value() >= 1.0 + BEND {
        return R::from(1.0) / force;
    }
    let beyond = force - R::from(1.0 - BEND);
    (force - beyond * beyond * R::from(0.25 / BEND)) / force
}
