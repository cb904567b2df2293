//! Piecewise cubics of the stretch, read in constant time.

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
        let coefficients = self.flow.iter().chain(&self.potential).chain(&self.stiffness);
        coefficients.chain([&self.centre])
    }
}

/// Pieces of extension, then of compression; centres are one apart in y = sqrt(scale u + shift), from
/// where the stretch u is zero.
pub(crate) type Table<T> = [Piece<T>; 2 * PIECES];

/// For each lane the piece around `y` on the side of `direction`, and z in it; `origin` turns y into
/// the index. Any `y` is safe to read.
#[inline(always)]
pub(crate) fn locate<'a, T: Real, const L: usize>(
    tables: [&'a Table<T>; L],
    origin: Lanes<T, L>,
    y: Lanes<T, L>,
    direction: Lanes<T, L>,
) -> ([&'a Piece<T>; L], Lanes<T, L>) {
    let mut z = y;
    let mut pieces = tables.map(|table| &table[0]);
    let places = (y + origin).0;
    for lane in 0..L {
        let index = places[lane].place() & (PIECES - 1);
        let piece = &tables[lane][index | (direction.0[lane].sign_bit() * PIECES)];
        pieces[lane] = piece;
        z.0[lane] = z.0[lane] - piece.centre;
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
