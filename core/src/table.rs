//! Piecewise cubics of the stretch, read in constant time.

use crate::math::Real;

/// Pieces a side.
pub(crate) const PIECES: usize = 64;

/// Two cubics of one piece: coefficients of 1, z, z^2, z^3, z in [-1/2, 1/2], both with the sign of
/// the stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Piece<T> {
    /// Flow of a stage [m] or force [N].
    pub(crate) response: [T; 4],
    /// Flow potential times the step [m^2].
    pub(crate) potential: [T; 4],
}

/// Pieces around y = 0, 1, 2, ... of extension, then of compression; y grows with the root of the
/// stretch.
pub(crate) type Table<T> = [Piece<T>; 2 * PIECES];

/// The piece around `y` (not negative, inside the table by construction) on the side of `direction`,
/// and z in it. Any `y` is safe to read.
#[inline(always)]
pub(crate) fn locate<T: Real>(table: &Table<T>, y: T, direction: T) -> (&Piece<T>, T) {
    let (index, z) = y.split();
    (
        &table[(index & (PIECES - 1)) | (direction.sign_bit() * PIECES)],
        z,
    )
}

/// `c0 + c1 z + c2 z^2 + c3 z^3`, in pairs: a shorter chain than Horner's for one product more.
#[inline(always)]
pub(crate) fn cubic<T: Real>(c: &[T; 4], z: T) -> T {
    (c[3] * z + c[2]) * (z * z) + (c[1] * z + c[0])
}
