//! Where a contact and its creepage lie in the book: creepages and forces as dimensionless numbers.

use std::ops::Mul;

use fearless_simd::{Simd, f64x4};

use super::pages::{GREATEST_SHAPE, Places, shape};
use crate::creep::{ContactLanes, Creepage, LoadedContact};
use crate::math::each::Each;
use crate::math::number::{Lanes, Number, are_within};

/// A contact in one lane or several, with what its creepages and forces are divided by.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact<C> {
    c11: C,
    c22: C,
    c23: C,
    /// `(a + b)/2`, m.
    mean_axis: C,
    /// `sqrt(a b)`, m.
    length: C,
    /// `G a b / (mu N)`.
    creepage: C,
    /// `mu N`, N.
    pub(super) force: C,
    /// `(a^2 + b^2)/(2 sqrt(a b))`, m: over this and `mu N` the moment of small spin hardly depends on `a/b`.
    pub(super) moment_arm: C,
    /// Place of the ratio of the semi-axes among those of the book, 0 to 1.
    pub(super) ratio: C,
}

impl<C: Number> Contact<C> {
    #[inline(always)]
    fn new(force: C, [a, b]: [C; 2], shear_modulus: f64, [c11, c22, c23]: [C; 3]) -> Self {
        let area = a * b;
        let (length, squares) = (area.sqrt(), a * a + b * b);
        Self {
            c11,
            c22,
            c23,
            mean_axis: (a + b) * 0.5,
            length,
            creepage: area * shear_modulus / force,
            force,
            moment_arm: squares * 0.5 / length,
            ratio: shape(a, b).limited(GREATEST_SHAPE) * (0.5 / GREATEST_SHAPE) + 0.5,
        }
    }
}

impl Contact<f64> {
    #[inline(always)]
    pub(super) fn of(contact: &LoadedContact) -> Self {
        let k = &contact.kalker;
        Self::new(
            contact.friction * contact.load_n,
            [contact.a_m, contact.b_m],
            contact.shear_modulus_pa,
            [k.c11, k.c22, k.c23],
        )
    }
}

/// Least creepage of the book at which the direction of sliding is differentiated: the book's numbers are in single precision, whose
/// last digit over a smaller one would be a slope of its own.
const LEAST_SLIDING: f64 = 1e-5;

impl Contact<f64> {
    /// The creepages, with as much longitudinal creepage as derivatives need where nothing slides but spins: there the direction
    /// of sliding has no derivative, though the forces have.
    #[inline(always)]
    pub(super) fn beside_pure_spin(&self, [xi, eta, phi]: [f64; 3]) -> [f64; 3] {
        let least = LEAST_SLIDING / (self.creepage * self.c22);
        if xi.hypot(eta) < least {
            [least.copysign(xi), eta, phi]
        } else {
            [xi, eta, phi]
        }
    }
}

impl<S: Simd> Contact<f64x4<S>> {
    #[inline(always)]
    pub(super) fn of_lanes(contacts: &ContactLanes<S>) -> Self {
        let [c11, c22, c23, _] = contacts.kalker;
        let force = contacts.friction * contacts.load;
        Self::new(
            force,
            contacts.semi_axes,
            contacts.shear_modulus,
            [c11, c22, c23],
        )
    }

    /// Whether all have a positive and finite friction force and semi-axes, as [`is_loaded`](super::is_loaded) asks for.
    #[inline(always)]
    pub(super) fn are_loaded(&self, load: f64x4<S>) -> bool {
        // Two negative semi-axes have a negative sum, and a product beyond the greatest number is infinite.
        let least = load
            .at_most(self.force)
            .at_most(self.length)
            .at_most(self.mean_axis);
        let greatest = self.force.at_least(self.length).at_least(self.mean_axis);
        are_within(least, 0.0, f64::MAX) & are_within(greatest, 0.0, f64::MAX)
    }
}

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
    pub(super) signs: [R; 2],
}

/// A square that keeps directions without creepage from being 0/0.
pub(super) const TINY: f64 = 1e-60;

impl<R: Number> Coordinates<R> {
    /// Of the creepages `[longitudinal, lateral, spin]`.
    ///
    /// With `(X, Y, Z) = G a b C22 / (mu N) (xi, eta, phi (a + b)/2)` and `q = X^2 + Y^2 + Z^2` the creepages of the
    /// book are `x = (X C11/C22 + X q)/(1 + q)`, `y = Y` and `z = (Z' C23/C22 + Z q)/(1 + q)`, where `Z'` has `sqrt(a b)`
    /// in place of `(a + b)/2`: forces of the linear theory where creepages are small, directions of sliding where they
    /// are large, whatever Poisson's ratio.
    #[inline(always)]
    pub(super) fn new<C: Number>(contact: &Contact<C>, creepage: [R; 3]) -> Self
    where
        R: Mul<C, Output = R>,
    {
        let [xi, eta, phi] = creepage.each(|creepage| creepage * contact.creepage);
        let (large_x, y) = (xi * contact.c22, eta * contact.c22);
        let large_z = phi * (contact.c22 * contact.mean_axis);
        let q = large_x * large_x + y * y + large_z * large_z;
        let weight = (q + 1.0).reciprocal();
        let x = (xi * contact.c11 + large_x * q) * weight;
        let z = (phi * (contact.c23 * contact.length) + large_z * q) * weight;
        let signs = [x.sign(), z.sign()];
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

    /// The place in the book's pages, in every lane, of a contact in one lane.
    #[inline(always)]
    pub(super) fn places<S: Simd>(&self, simd: S, contact: &Contact<f64>) -> Places<S> {
        let direction = 0.5 + 0.5 * self.direction.lane(0);
        let coordinates = [
            contact.ratio,
            self.size.lane(0),
            self.spin.lane(0),
            direction,
        ];
        Places::new(
            simd,
            coordinates.each(|coordinate| simd.splat_f64x4(coordinate)),
        )
    }
}

/// The numbers of a creepage in the order of the coordinates' formulas.
#[inline(always)]
pub(super) fn numbers(creepage: &Creepage) -> [f64; 3] {
    [creepage.longitudinal, creepage.lateral, creepage.spin_per_m]
}
