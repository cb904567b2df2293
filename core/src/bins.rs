//! Bins that divide the range of a stage's reach. The exponent and the leading fraction bits of the reach give the
//! index of its bin.

/// Number of bins per side (extension or compression). They cover 16 doublings of the reach.
pub(crate) const BINS: usize = 1 << BIN_BITS;
const BIN_BITS: u32 = 11;

/// Number of leading fraction bits in the index of a bin.
const BIN_FRACTION_BITS: u32 = 7;

/// Number of doublings of the reach from the first knot to the end of the bins.
pub(crate) const DOUBLINGS: u32 = 1 << (BIN_BITS - BIN_FRACTION_BITS);

const _: () = assert!(
    BIN_FRACTION_BITS < BIN_BITS,
    "the bins must cover several doublings"
);

/// Number of low bits that do not belong to the bin index, in a float with this many significant binary digits.
pub(crate) const fn bin_shift(digits: u32) -> u32 {
    digits - 1 - BIN_FRACTION_BITS
}
