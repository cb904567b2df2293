//! Dimensionless coordinates of a contact and its creepage in the book.

use std::ops::Mul;

use fearless_simd::{Simd, SimdBase, f64x4};

use super::pages::{BookPositions, MAX_SHAPE};
use crate::creep::shape::shape;
use crate::creep::{ContactLanes, Creepage, KalkerCoefficients, LoadedContact};
use crate::math::each::Each;
use crate::math::number::{Number, are_within};

/// A contact in one or more lanes, with the scales of its creepages and forces.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact<C> {
    c11: C,
    c22: C,
    c23: C,
    /// `(a + b)/2`, m.
    mean_axis: C,
    /// `sqrt(a b)`, m.
    length: C,
    /// Scale of creepages, `G a b / (mu N)`.
    creepage: C,
    /// Scale of forces, `mu N`, N.
    pub(super) force: C,
    /// `(a^2 + b^2)/(2 sqrt(a b))`, m. The moment of a small spin, divided by this and `mu N`, hardly depends on `a/b`.
    pub(super) moment_arm: C,
    /// Coordinate of the ratio of the semi-axes in the book, 0 to 1.
    pub(super) ratio: C,
}

impl<C: Number> Contact<C> {
    #[inline(always)]
    fn new(force: C, [a, b]: [C; 2], shear_modulus: f64, kalker: &KalkerCoefficients<C>) -> Self {
        let area = a * b;
        let (length, squares) = (area.sqrt(), a * a + b * b);
        Self {
            c11: kalker.c11,
            c22: kalker.c22,
            c23: kalker.c23,
            mean_axis: (a + b) * 0.5,
            length,
            creepage: area * shear_modulus / force,
            force,
            moment_arm: squares * 0.5 / length,
            ratio: shape(a, b).limited(MAX_SHAPE) * (0.5 / MAX_SHAPE) + 0.5,
        }
    }
}

impl Contact<f64> {
    #[inline(always)]
    pub(super) fn from_loaded(contact: &LoadedContact) -> Self {
        Self::new(
            contact.friction * contact.load_n,
            [contact.a_m, contact.b_m],
            contact.shear_modulus_pa,
            &contact.kalker,
        )
    }
}

/// Minimum scaled creepage at which the direction of sliding is differentiated. The coefficients of the book are in
/// single precision; over smaller creepages their rounding would cause a large slope.
const MIN_SLIDING: f64 = 1e-5;

impl Contact<f64> {
    /// Replaces the longitudinal creepage near pure spin by a small one, at which the direction of sliding has
    /// derivatives. In pure spin the direction has no derivatives, although the forces do.
    #[inline(always)]
    pub(super) fn beside_pure_spin(&self, [xi, eta, phi]: [f64; 3]) -> [f64; 3] {
        let min = MIN_SLIDING / (self.creepage * self.c22);
        if libm::hypot(xi, eta) < min {
            [min.copysign(xi), eta, phi]
        } else {
            [xi, eta, phi]
        }
    }
}

impl<S: Simd> Contact<f64x4<S>> {
    #[inline(always)]
    pub(super) fn from_lanes(contacts: &ContactLanes<S>) -> Self {
        let force = contacts.friction * contacts.load;
        Self::new(
            force,
            contacts.semi_axes,
            contacts.shear_modulus,
            &contacts.kalker,
        )
    }

    /// True if friction force and semi-axes are positive and finite in all lanes, as in
    /// [`is_loaded`](super::is_loaded).
    #[inline(always)]
    pub(super) fn are_loaded(&self, load: f64x4<S>) -> bool {
        // `mean_axis` is negative if both semi-axes are, and `length` is infinite if their product overflows.
        let min = load.min(self.force).min(self.length).min(self.mean_axis);
        let max = self.force.max(self.length).max(self.mean_axis);
        are_within(min, 0.0, f64::MAX) & are_within(max, 0.0, f64::MAX)
    }
}

/// Coordinates in the book, for a creepage mirrored into the tabulated quadrant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coordinates<R> {
    /// Size of the creepage, 0 to 1: `r / (r + 1)`, where `r` is the magnitude of `(x, y, z)`.
    pub(super) size: R,
    /// Share of spin, 0 to 1: `h (9 - h^2) / 8`, which is the angle of spin divided by a right angle, within 3 %. Here
    /// `h = z / (r + s)` is the tangent of half the angle, and `s` the magnitude of `(x, y)`.
    pub(super) spin: R,
    /// Direction of sliding, -1 to 1: `y / (s + |x|)`, the tangent of half its angle to the rolling direction.
    pub(super) direction: R,
    /// Signs (1 or -1) of the longitudinal force, and of lateral force and moment.
    pub(super) signs: [R; 2],
}

/// Added to squares so that the direction without creepage is not 0/0.
pub(super) const TINY: f64 = 1e-60;

impl<R: Number> Coordinates<R> {
    /// Coordinates of the creepages `[longitudinal, lateral, spin]`.
    ///
    /// With `(X, Y, Z) = G a b C22 / (mu N) (xi, eta, phi (a + b)/2)` and `q = X^2 + Y^2 + Z^2`, the scaled creepages
    /// are `x = (X C11/C22 + X q)/(1 + q)`, `y = Y` and `z = (Z' C23/C22 + Z q)/(1 + q)`, where `Z'` is `Z` with
    /// `sqrt(a b)` instead of `(a + b)/2`. For any Poisson's ratio they give the forces of the linear theory at small
    /// creepages and the directions of sliding at large ones.
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

    /// Position in the pages of the book, repeated in every lane.
    #[inline(always)]
    pub(super) fn positions<S: Simd>(&self, simd: S, contact: &Contact<f64>) -> BookPositions<S> {
        let direction = 0.5 + 0.5 * self.direction.lane(0);
        let coordinates = [
            contact.ratio,
            self.size.lane(0),
            self.spin.lane(0),
            direction,
        ];
        BookPositions::new(
            simd,
            coordinates.each(|coordinate| simd.splat_f64x4(coordinate)),
        )
    }
}

/// The components `[longitudinal, lateral, spin]` of a creepage.
#[inline(always)]
pub(super) fn components(creepage: &Creepage) -> [f64; 3] {
    [creepage.longitudinal, creepage.lateral, creepage.spin_per_m]
}
