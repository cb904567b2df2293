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
    /// book are `x = (X C11/C22 + X q)/(1 + q)`, `y = Y` and `z = (Z' C23/C22 + Z q)/(1 + q)`, where `Z'` has `sqrt(a b)`
    /// in place of `(a + b)/2`: forces of the linear theory where creepages are small, directions of sliding where they
    /// are large, whatever Poisson's ratio.
    #[inline]
    pub(super) fn new(contact: &LoadedContact, scale: &Scale, creepage: [R; 3]) -> Self {
        let k = &contact.kalker;
        let [xi, eta, phi] = creepage.map(|creepage| creepage * scale.creepage);
        let (large_x, y) = (xi * k.c22, eta * k.c22);
        let large_z = phi * (k.c22 * 0.5 * (contact.a_m + contact.b_m));
        let q = large_x * large_x + y * y + large_z * large_z;
        let weight = (q + 1.0).reciprocal();
        let x = (xi * k.c11 + large_x * q) * weight;
        let z = (phi * (k.c23 * scale.length) + large_z * q) * weight;
        let signs = [x.lane(0), z.lane(0)].map(|value| 1f64.copysign(value));
        let (x, y, z) = (x * signs[0], y * signs[1], z * signs[1]);
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
    pub(super) length: f64,
    /// `(a^2 + b^2)/(2 sqrt(a b))`, m: over this and `mu N` the moment of small spin hardly depends on `a/b`.
    pub(super) moment_arm: f64,
    /// `G a b / (mu N)`.
    pub(super) creepage: f64,
}

impl Scale {
    #[inline]
    pub(super) fn new(contact: &LoadedContact) -> Self {
        let area = contact.a_m * contact.b_m;
        let force = contact.friction * contact.load_n;
        let length = area.sqrt();
        Self {
            force,
            length,
            moment_arm: 0.5 * (contact.a_m * contact.a_m + contact.b_m * contact.b_m) / length,
            creepage: contact.shear_modulus_pa * area / force,
        }
    }
}

/// The numbers of a creepage in the order of the coordinates' formulas.
#[inline]
pub(super) fn numbers(creepage: &Creepage) -> [f64; 3] {
    [creepage.longitudinal, creepage.lateral, creepage.spin_per_m]
}
