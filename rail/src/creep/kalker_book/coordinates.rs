//! Where a contact and its creepage lie in the book: creepages and forces as dimensionless numbers.

use crate::creep::{Creepage, LoadedContact};
use crate::math::number::Number;

/// A place in the book, for a creepage that is turned into the book's quarter of all directions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coordinates<R> {
    /// Size of the creepage, 0 to 1: `r / (r + 1)`, where `r` is the magnitude of `(x, y, z)`.
    pub(super) size: R,
    /// Share of spin, 0 to 1: `h (9 - h^2) / 8`, the angle of spin over a right angle within 3 %, where
    /// `h = z / (r + s)` is the tangent of half the angle and `s` the magnitude of `(x, y)`.
    pub(super) spin: R,
    /// Direction of sliding, -1 to 1: `y / (s + |x|)`, the tangent of half its angle against rolling.
    pub(super) direction: R,
    /// 1 or -1: what the longitudinal force, and what lateral force and moment are multiplied by.
    pub(super) signs: [f64; 2],
}

/// A square that keeps directions without creepage from being 0/0.
const TINY: f64 = 1e-60;

impl<R: Number> Coordinates<R> {
    /// Of the creepages `[longitudinal, lateral, spin]`.
    ///
    /// With `(X, Y, Z) = G a b C22 / (mu N) (xi, eta, phi (a + b)/2)` and `q = X^2 + Y^2 + Z^2` the creepages of the
    /// book are `x = X (C11/C22 + q)/(1 + q)`, `y = Y`, `z = Z (C23/C22 + q)/(1 + q)`: forces of the linear theory
    /// where creepages are small, directions of sliding where they are large, whatever Poisson's ratio.
    #[inline]
    pub(super) fn new(contact: &LoadedContact, scale: &Scale, creepage: [R; 3]) -> Self {
        let [xi, eta, phi] = creepage;
        let k = &contact.kalker;
        let (xi, eta) = (xi * scale.creepage, eta * scale.creepage);
        let phi = phi * (scale.creepage * scale.spin_arm);
        let q = (xi * xi + eta * eta + phi * phi) * (k.c22 * k.c22);
        let weight = (q + 1.0).reciprocal();
        let large = q * k.c22;
        let (x, z) = (
            xi * (large + k.c11) * weight,
            phi * (large + k.c23) * weight,
        );
        let signs = [x.lane(0), z.lane(0)].map(|value| 1f64.copysign(value));
        let (x, y, z) = (x * signs[0], eta * (k.c22 * signs[1]), z * signs[1]);
        let square = x * x + y * y + TINY;
        let s = square.sqrt();
        let r = (square + z * z).sqrt();
        let h = z / (r + s);
        Self {
            size: r / (r + 1.0),
            spin: h * (-(h * h) + 9.0) * 0.125,
            direction: y / (s + x),
            signs,
        }
    }
}

/// What creepages and forces of a contact are divided by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    /// `mu N`, N.
    pub(super) force: f64,
    /// `sqrt(a b)`, m.
    pub(super) moment_arm: f64,
    /// `(a + b)/2`, m: what spin slides at counts from the longer semi-axis.
    pub(super) spin_arm: f64,
    /// `G a b / (mu N)`.
    pub(super) creepage: f64,
}

impl Scale {
    #[inline]
    pub(super) fn new(contact: &LoadedContact) -> Self {
        let area = contact.a_m * contact.b_m;
        let force = contact.friction * contact.load_n;
        Self {
            force,
            moment_arm: area.sqrt(),
            spin_arm: 0.5 * (contact.a_m + contact.b_m),
            creepage: contact.shear_modulus_pa * area / force,
        }
    }
}

/// The numbers of a creepage in the order of the coordinates' formulas.
#[inline]
pub(super) fn numbers(creepage: &Creepage) -> [f64; 3] {
    [creepage.longitudinal, creepage.lateral, creepage.spin_per_m]
}
