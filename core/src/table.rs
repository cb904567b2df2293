//! Piecewise cubics of the stretch, read in constant time.

use crate::math::{Lanes, Real};

/// Pieces a side.
pub(crate) const PIECES: usize = 64;

/// Cubics of one piece: coefficients of 1, z, z^2, z^3, z in [-1/2, 1/2].
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Piece<T> {
    /// Flow times the step (m), with the sign of the stretch.
    pub(crate) flow: [T; 4],
    /// Flow potential times the step (m^2), positive.
    pub(crate) potential: [T; 4],
    /// Force beyond friction over stretch beyond the offset, less the held stiffness (N/m).
    pub(crate) stiffness: [T; 4],
}

impl<T> Piece<T> {
    /// The coefficients in order of declaration.
    pub(crate) fn coefficients(&self) -> impl Iterator<Item = &T> {
        self.flow
            .iter()
            .chain(&self.potential)
            .chain(&self.stiffness)
    }
}

/// Pieces around y = 0, 1, 2, ... of extension, then of compression; y grows with the root of the
/// stretch.
pub(crate) type Table<T> = [Piece<T>; 2 * PIECES];

/// For each lane the piece around `y` (not negative, inside the table by construction) on the side of
/// `direction`, and z in it. Any `y` is safe to read.
#[inline(always)]
pub(crate) fn locate<T: Real, const L: usize>(
    tables: [&Table<T>; L],
    y: Lanes<T, L>,
    direction: Lanes<T, L>,
) -> ([&Piece<T>; L], Lanes<T, L>) {
    let mut z = y;
    let mut pieces = tables.map(|table| &table[0]);
    for (((piece, table), z), direction) in
        pieces.iter_mut().zip(tables).zip(&mut z.0).zip(direction.0)
    {
        let (index, rest) = z.split();
        *piece = &table[(index & (PIECES - 1)) | (direction.sign_bit() * PIECES)];
        *z = rest;
    }
    (pieces, z)
}

/// `c0 + c1 z + c2 z^2 + c3 z^3` of each lane, in pairs: a shorter chain than Horner's for one product
/// more.
#[inline(always)]
pub(crate) fn cubic<T: Real, const L: usize>(c: [&[T; 4]; L], z: Lanes<T, L>) -> Lanes<T, L> {
    let c0 = Lanes(c.map(|c| c[0]));
    let c1 = Lanes(c.map(|c| c[1]));
    let c2 = Lanes(c.map(|c| c[2]));
    let c3 = Lanes(c.map(|c| c[3]));
    (c3 * z + c2) * (z * z) + (c1 * z + c0)
}
