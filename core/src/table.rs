//! Piecewise cubics of a stage's reach, found and read in constant time.
//!
//! Knots lie where the law has its corners and as close between them as its curvature asks, so they are
//! not equally spaced. A reach finds its piece through bins: its exponent and the leading bits of its
//! fraction, 128 bins to each doubling, name a bin, and a bin names the piece around its lower border.
//! At most [`KNOTS_PER_BIN`] knots lie within a bin, so as many comparisons end at the right piece.

use crate::encoding::checksum;
use crate::math::Lanes;

/// Pieces a side.
pub(crate) const PIECES: usize = 64;

/// Bins a side: 16 doublings of the reach.
pub(crate) const BINS: usize = 1 << BIN_BITS;
pub(crate) const BIN_BITS: u32 = 11;

/// Leading bits of the fraction that take part in the number of a bin.
pub(crate) const BIN_FRACTION_BITS: u32 = 7;

/// Knots within a bin.
pub(crate) const KNOTS_PER_BIN: usize = 2;

/// Doublings of the reach from the first knot to the end of the bins.
pub(crate) const DOUBLINGS: u32 = 1 << (BIN_BITS - BIN_FRACTION_BITS);

const _: () = {
    assert!(
        PIECES >= 64,
        "docs/numerics.md promises an accuracy that fewer pieces do not reach"
    );
    assert!(
        (2 * PIECES).is_power_of_two(),
        "an index is masked to be within bounds"
    );
    assert!(2 * PIECES <= 256, "a bin names a piece by a byte");
    assert!(KNOTS_PER_BIN == 2, "the step compares with two knots");
    assert!(
        BIN_FRACTION_BITS < BIN_BITS,
        "a bin is a part of a doubling"
    );
    assert!(
        size_of::<Piece<f32>>() == 64,
        "the address of a piece takes one shift"
    );
};

/// Parts in which bins are set.
pub(crate) const INDEX_SLICES: usize = 2 * BINS / BINS_PER_SLICE;
const BINS_PER_SLICE: usize = 64;

/// Rows of four numbers of a table: bins by fours of their bytes, then the rows of each piece.
pub(crate) const ROWS: usize = BIN_ROWS + 4 * 2 * PIECES;
const BIN_ROWS: usize = BINS / BINS_PER_ROW;
const BINS_PER_ROW: usize = 8;

/// Cubics of one piece in z, the reach beyond its knot: coefficients of 1, z, z^2, z^3. Sixteen numbers,
/// so that its address takes one shift.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Piece<T> {
    /// Flow times the step (m), with the sign of the stretch.
    pub(crate) flow: [T; 4],
    /// Flow potential times the step (m^2), positive.
    pub(crate) potential: [T; 4],
    /// Force over stretch beyond the clearance (N/m).
    pub(crate) stiffness: [T; 4],
    /// Where the piece begins (m).
    pub(crate) knot: T,
    /// Where the next pieces begin (m).
    pub(crate) next_knots: [T; KNOTS_PER_BIN],
    pub(crate) padding: T,
}

impl<T> Piece<T> {
    /// The numbers that mean something, in order of declaration.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = &T> {
        let coefficients = self
            .flow
            .iter()
            .chain(&self.potential)
            .chain(&self.stiffness);
        coefficients.chain([&self.knot])
    }

    /// As [`Piece::numbers`], to be written.
    pub(crate) fn numbers_mut(&mut self) -> impl Iterator<Item = &mut T> {
        let coefficients = self.flow.iter_mut().chain(&mut self.potential);
        coefficients
            .chain(&mut self.stiffness)
            .chain([&mut self.knot])
    }
}

/// Pieces of extension, then of compression, and the bins that find them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Table<T> {
    /// Of either side by turns, so that a bin takes one address.
    pub(crate) bins: [[u8; 2]; BINS],
    pub(crate) pieces: [Piece<T>; 2 * PIECES],
}

macro_rules! table {
    ($float:ident, $word:ident) => {
        impl Table<$float> {
            /// Pieces without meaning, to be written.
            pub(crate) const ZERO: Self = Self {
                pieces: [Piece {
                    flow: [0.0; 4],
                    potential: [0.0; 4],
                    stiffness: [0.0; 4],
                    knot: 0.0,
                    next_knots: [0.0; KNOTS_PER_BIN],
                    padding: 0.0,
                }; 2 * PIECES],
                bins: [[0; 2]; BINS],
            };

            /// Sets bins and next knots by the knots. Knots rise on either side, the first a power of two.
            pub(crate) const fn index(&mut self) {
                let (mut slice, mut piece) = (0, 0);
                while slice < INDEX_SLICES {
                    piece = self.index_slice(slice, piece);
                    slice += 1;
                }
            }

            /// A part of [`Self::index`], the parts in order; `piece` is what the part before returned.
            pub(crate) const fn index_slice(&mut self, slice: usize, piece: usize) -> usize {
                const WIDTH: $word = 1 << bin_shift($float::MANTISSA_DIGITS);
                let side = slice / (INDEX_SLICES / 2) % 2;
                let (start, end) = (side * PIECES, (side + 1) * PIECES);
                let mut bin = slice * BINS_PER_SLICE % BINS;
                let mut piece = if bin == 0 {
                    self.link_knots(start, end)
                } else {
                    piece
                };
                let first = self.pieces[start].knot.to_bits();
                let last = bin + BINS_PER_SLICE;
                while bin < last {
                    let border = first.wrapping_add(WIDTH * bin as $word);
                    while piece + 1 < end && self.pieces[piece + 1].knot.to_bits() <= border {
                        piece += 1;
                    }
                    let place = (border / WIDTH) as usize % BINS;
                    self.bins[place][side] = piece as u8;
                    bin += 1;
                }
                piece
            }

            /// Writes into the pieces from `start` to `end` where the next ones begin; returns the first.
            const fn link_knots(&mut self, start: usize, end: usize) -> usize {
                let mut piece = start;
                while piece < end {
                    let mut next = 0;
                    while next < KNOTS_PER_BIN {
                        let after = piece + next + 1;
                        self.pieces[piece].next_knots[next] = if after < end {
                            self.pieces[after].knot
                        } else {
                            $float::MAX
                        };
                        next += 1;
                    }
                    piece += 1;
                }
                start
            }

            /// CRC-32 of the table as it lies in memory.
            pub(crate) const fn check(&self) -> u32 {
                let (mut crc, mut row) = (0, 0);
                while row < ROWS {
                    crc = self.check_row(row, crc);
                    row += 1;
                }
                crc
            }

            /// CRC-32 of the rows before and this one.
            pub(crate) const fn check_row(&self, row: usize, crc: u32) -> u32 {
                if row < BIN_ROWS {
                    let mut bytes = [0; 2 * BINS_PER_ROW];
                    let mut bin = 0;
                    while bin < BINS_PER_ROW {
                        [bytes[2 * bin], bytes[2 * bin + 1]] =
                            self.bins[(BINS_PER_ROW * row + bin) % BINS];
                        bin += 1;
                    }
                    return checksum::continued(crc, &bytes);
                }
                let row = row - BIN_ROWS;
                let piece = &self.pieces[row / 4 % (2 * PIECES)];
                let [next, second] = piece.next_knots;
                let numbers = match row % 4 {
                    0 => piece.flow,
                    1 => piece.potential,
                    2 => piece.stiffness,
                    _ => [piece.knot, next, second, piece.padding],
                };
                const BYTES: usize = size_of::<$word>();
                let mut bytes = [0; 4 * BYTES];
                let mut byte = 0;
                while byte < 4 * BYTES {
                    bytes[byte] = (numbers[byte / BYTES].to_bits() >> (byte % BYTES * 8)) as u8;
                    byte += 1;
                }
                checksum::continued(crc, &bytes)
            }
        }
    };
}

table!(f32, u32);
table!(f64, u64);

/// Bits below those that number a bin, in a number with so many significant digits.
pub(crate) const fn bin_shift(digits: u32) -> u32 {
    digits - 1 - BIN_FRACTION_BITS
}

/// For each lane the piece around the positive `reach` on the side of `direction`, and z in it. Any
/// number is safe to look up.
#[inline(always)]
pub(crate) fn locate<T: Copy, V: Lanes<T, L>, const L: usize>(
    tables: [&Table<T>; L],
    reach: V,
    direction: V,
) -> ([&Piece<T>; L], V) {
    let (bins, sides) = (reach.bins(), direction.sign_bits());
    let first: [usize; L] = core::array::from_fn(|lane| {
        usize::from(tables[lane].bins[bins[lane] % BINS][sides[lane] % 2])
    });
    let passed = reach.knots_passed(core::array::from_fn(|lane| {
        let piece = &tables[lane].pieces[first[lane] % (2 * PIECES)];
        let [next, second] = piece.next_knots;
        [piece.knot, next, second, piece.padding]
    }));
    let pieces = core::array::from_fn(|lane| {
        &tables[lane].pieces[(first[lane] + passed[lane]) % (2 * PIECES)]
    });
    let knot = V::new(pieces.map(|piece: &Piece<T>| piece.knot));
    (pieces, reach - knot)
}

/// `c0 + c1 z + c2 z^2 + c3 z^3` of each lane, in pairs: a shorter chain than Horner's for one product
/// more.
#[inline(always)]
pub(crate) fn cubic<T: Copy, V: Lanes<T, L>, const L: usize>(coefficients: [[T; 4]; L], z: V) -> V {
    let [c0, c1, c2, c3] = V::transpose(coefficients);
    (c3 * z + c2) * (z * z) + (c1 * z + c0)
}
