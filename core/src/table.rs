//! Piecewise cubics in the reach of a stage, found and evaluated in constant time.
//!
//! The knots are at the corners of the law, with more between them where the law is curved, so they are not equally
//! spaced. The reach of a stage is its stretch plus gamma times its flow. Bins find the piece that contains a reach.
//! The exponent and the leading bits of the fraction of the reach select a bin, with 128 bins for each doubling. A bin
//! contains the piece at its lower border. At most one knot lies within a bin, so one comparison finds the piece.

use core::hint::select_unpredictable;

use crate::bins::{BINS, bin_shift};
use crate::checksum;
use crate::math::Lanes;

/// Number of pieces per side (extension or compression).
pub(crate) const PIECES: usize = 64;

/// Number of pieces after those of both sides. All their numbers are zero. With them every value of a bin, and the
/// piece after it, is within the table, so the step checks no index.
const SPARE_PIECES: usize = 2;

/// Cubics and knot of a piece, in [`ROWS_PER_PIECE`] rows.
///
/// A cubic is a row of the coefficients of 1, z, z^2, z^3, where z is the reach beyond the knot. A piece has sixteen
/// numbers, so one shift computes its address.
pub(crate) type Piece<T> = [[T; 4]; ROWS_PER_PIECE];

/// Number of rows of a piece.
pub(crate) const ROWS_PER_PIECE: usize = 4;

/// Number of numbers of a piece.
#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
pub(crate) const NUMBERS_PER_PIECE: usize = 4 * ROWS_PER_PIECE;
/// Row of a piece: flow `v_h` times the step (m). It has the sign of the stretch.
pub(crate) const FLOW: usize = 0;
/// Row of a piece: flow potential times the step (m^2), positive.
pub(crate) const POTENTIAL: usize = 1;
/// Row of a piece: ratio of the force to the stretch beyond the clearance (N/m).
pub(crate) const STIFFNESS: usize = 2;
/// Row of a piece: start of the piece (m), start of the next piece (m), two unused numbers.
pub(crate) const KNOTS: usize = 3;

/// Number of numbers of a piece that a build computes, which come first: three cubics and the knot.
pub(crate) const BUILT_NUMBERS: usize = 13;

const _: () = {
    assert!(
        PIECES >= 64,
        "fewer pieces do not reach the accuracy of docs/numerics.md"
    );
    assert!(
        2 * 2 * PIECES <= 256,
        "twice the index of a piece must fit into a byte"
    );
    assert!(
        u8::MAX as usize / 2 + 2 < 2 * PIECES + SPARE_PIECES,
        "the rows after any value of a bin must be within the table"
    );
    assert!(
        size_of::<Piece<f32>>() == 64,
        "a shift by 5 bits of twice its index computes the address of a piece"
    );
};

/// Number of slices in which the bins are computed.
pub(crate) const INDEX_SLICES: usize = 2 * BINS / BINS_PER_SLICE;
const BINS_PER_SLICE: usize = 64;

/// Number of rows of a table: those of the bins, then those of the pieces, with four numbers in each row.
pub(crate) const ROWS: usize = BIN_ROWS + ROWS_PER_PIECE * (2 * PIECES + SPARE_PIECES);
const BIN_ROWS: usize = BINS / BINS_PER_ROW;
const BINS_PER_ROW: usize = 8;

/// Pieces of extension, then of compression, with their bins.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub(crate) struct Table<T> {
    pub(crate) pieces: [Piece<T>; 2 * PIECES + SPARE_PIECES],
    /// Twice the index of the piece at the lower border of each bin. A bin has an entry for extension and one for
    /// compression, so that one address serves both.
    pub(crate) bins: [[u8; 2]; BINS],
}

impl<T> Table<T> {
    /// Iterates over the numbers that a build computes, piece by piece.
    pub(crate) fn built_numbers(&self) -> impl Iterator<Item = &T> {
        let pieces = self.pieces.iter().take(2 * PIECES);
        pieces.flat_map(|piece| piece.as_flattened().iter().take(BUILT_NUMBERS))
    }
}

macro_rules! table {
    ($float:ident, $word:ident) => {
        impl Table<$float> {
            /// A table of zeros.
            pub(crate) const ZERO: Self = Self {
                pieces: [[[0.0; 4]; ROWS_PER_PIECE]; 2 * PIECES + SPARE_PIECES],
                bins: [[0; 2]; BINS],
            };

            /// Sets bins and next knots from the knots, which increase on each side. The first knot is a power of two.
            pub(crate) const fn index(&mut self) {
                let (mut slice, mut piece) = (0, 0);
                while slice < INDEX_SLICES {
                    piece = self.index_slice(slice, piece);
                    slice += 1;
                }
            }

            /// Sets one slice of the bins, in order. `piece` is the result of the previous slice.
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
                let first = self.pieces[start][KNOTS][0].to_bits();
                let last = bin + BINS_PER_SLICE;
                while bin < last {
                    let border = first.wrapping_add(WIDTH * bin as $word);
                    while piece + 1 < end && self.pieces[piece + 1][KNOTS][0].to_bits() <= border {
                        piece += 1;
                    }
                    let index = (border / WIDTH) as usize % BINS;
                    self.bins[index][side] = 2 * piece as u8;
                    bin += 1;
                }
                piece
            }

            /// Sets the next knots of the pieces from `start` to `end`. Returns `start`.
            const fn link_knots(&mut self, start: usize, end: usize) -> usize {
                let mut piece = start;
                while piece < end {
                    let after = piece + 1;
                    self.pieces[piece][KNOTS][1] = if after < end {
                        self.pieces[after][KNOTS][0]
                    } else {
                        $float::MAX
                    };
                    piece = after;
                }
                start
            }

            /// CRC-32 of the table in memory.
            pub(crate) const fn check(&self) -> u32 {
                let (mut crc, mut row) = (0, 0);
                while row < ROWS {
                    crc = self.check_row(row, crc);
                    row += 1;
                }
                crc
            }

            /// Continues a CRC-32 over a row.
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
                let piece = &self.pieces[row / ROWS_PER_PIECE % (2 * PIECES + SPARE_PIECES)];
                let numbers = piece[row % ROWS_PER_PIECE];
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

/// Finds the piece of the positive `reach` on the side of `direction`, and z in it, for each lane. Any number is safe.
#[inline(always)]
pub(crate) fn locate<T: Copy, V: Lanes<T, L>, const L: usize>(
    tables: [&Table<T>; L],
    reach: V,
    direction: V,
) -> ([&Piece<T>; L], V) {
    let (bins, sides) = (reach.bins(), direction.sign_bits());
    let first: [usize; L] = core::array::from_fn(|lane| {
        // In this order the address takes one addition and the load a shift.
        let entries = &tables[lane].bins.as_flattened()[sides[lane] % 2..];
        usize::from(entries[2 * (bins[lane] % BINS)])
    });
    let rows: [&[[T; 4]]; L] = core::array::from_fn(|lane| {
        &tables[lane].pieces.as_flattened()[ROWS_PER_PIECE / 2 * first[lane]..]
    });
    let passed = reach.exceeds(V::new(rows.map(|rows| rows[KNOTS][1])));
    let pieces = core::array::from_fn(|lane| {
        // One conditional addition to the address; a product with `passed` takes two instructions more.
        let rows = select_unpredictable(passed[lane], &rows[lane][ROWS_PER_PIECE..], rows[lane]);
        rows.first_chunk().unwrap_or(&tables[lane].pieces[0])
    });
    let knot = V::new(pieces.map(|piece: &Piece<T>| piece[KNOTS][0]));
    (pieces, reach - knot)
}

/// Evaluates `c0 + c1 z + c2 z^2 + c3 z^3` of each lane in two pairs of terms. Compared with Horner's rule, the chain
/// of operations is shorter at the cost of one more product.
#[inline(always)]
pub(crate) fn cubic<T: Copy, V: Lanes<T, L>, const L: usize>(coefficients: [[T; 4]; L], z: V) -> V {
    let [c0, c1, c2, c3] = V::transpose(coefficients);
    (c3 * z + c2) * (z * z) + (c1 * z + c0)
}

#[cfg(test)]
mod tests {
    use super::{KNOTS, PIECES, Table, locate};

    /// The knots of a side grow by the same factor, from 1 m on.
    fn table(growth: [f64; 2]) -> Table<f64> {
        let mut table = Table::<f64>::ZERO;
        for (side, growth) in table.pieces.chunks_exact_mut(PIECES).zip(growth) {
            let mut knot = 1.0;
            for piece in side {
                piece[KNOTS][0] = knot;
                knot *= growth;
            }
        }
        table.index();
        table
    }

    #[test]
    fn every_reach_is_located_in_its_own_piece() {
        // A bin is at most 1/128 of its reach wide and contains at most one knot.
        for growth in [[1.1, 1.12], [1.008, 1.009]] {
            let table = table(growth);
            for (side, direction) in [(0, 1.0), (1, -1.0)] {
                for number in 0..PIECES {
                    let piece = &table.pieces[side * PIECES + number];
                    for share in [0.01, 0.5, 0.99] {
                        let beyond = share * (growth[side] - 1.0) * piece[KNOTS][0];
                        let reach = piece[KNOTS][0] + beyond;
                        let ([found], z) = locate::<f64, f64, 1>([&table], reach, direction);
                        assert_eq!(
                            found[KNOTS][0], piece[KNOTS][0],
                            "side {side}, share {share}"
                        );
                        assert_eq!(z, reach - piece[KNOTS][0]);
                        assert!(core::ptr::eq(found, piece));
                    }
                }
            }
        }
    }
}
