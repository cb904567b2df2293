//! Piecewise cubics of a stage's reach, read in constant time.

use crate::math::{Lanes, Real};

/// Pieces a side.
pub(crate) const PIECES: usize = 64;

/// Cubics of one piece in z = y - centre: coefficients of 1, z, z^2, z^3. Sixteen numbers, so that its
/// address takes one shift.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Piece<T> {
    /// Flow times the step (m), with the sign of the stretch.
    pub(crate) flow: [T; 4],
    /// Flow potential times the step (m^2), positive.
    pub(crate) potential: [T; 4],
    /// Force beyond friction over stretch beyond the offset, less the held stiffness (N/m).
    pub(crate) stiffness: [T; 4],
    /// Where z is zero (1).
    pub(crate) centre: T,
    pub(crate) padding: [T; 3],
}

impl<T> Piece<T> {
    /// The numbers that mean something, in order of declaration.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = &T> {
        let coefficients = self
            .flow
            .iter()
            .chain(&self.potential)
            .chain(&self.stiffness);
        coefficients.chain([&self.centre])
    }

    /// As [`Piece::numbers`], to be written.
    pub(crate) fn numbers_mut(&mut self) -> impl Iterator<Item = &mut T> {
        let coefficients = self.flow.iter_mut().chain(&mut self.potential);
        coefficients
            .chain(&mut self.stiffness)
            .chain([&mut self.centre])
    }
}

/// Pieces of extension, then of compression; centres are one apart in y = sqrt(scale u + shift), from
/// where the stretch u is zero.
pub(crate) type Table<T> = [Piece<T>; 2 * PIECES];

/// For each lane the piece around `y` on the side of `direction`, and z in it; `origin` turns y into
/// the index. Any `y` is safe to read.
#[inline(always)]
pub(crate) fn locate<T: Real, V: Lanes<T, L>, const L: usize>(
    tables: [&Table<T>; L],
    origin: V,
    y: V,
    direction: V,
) -> ([&Piece<T>; L], V) {
    let places = (y + origin).places(direction);
    let pieces = core::array::from_fn(|lane| &tables[lane][places[lane] % (2 * PIECES)]);
    let centre = V::new(pieces.map(|piece: &Piece<T>| piece.centre));
    (pieces, y - centre)
}

/// `c0 + c1 z + c2 z^2 + c3 z^3` of each lane, in pairs: a shorter chain than Horner's for one product
/// more.
#[inline(always)]
pub(crate) fn cubic<T: Real, V: Lanes<T, L>, const L: usize>(coefficients: [[T; 4]; L], z: V) -> V {
    let [c0, c1, c2, c3] = V::columns(coefficients);
    (c3 * z + c2) * (z * z) + (c1 * z + c0)
}
