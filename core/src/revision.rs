//! A number that tells built dampers apart: FNV-1a (Fowler, Noll, Vo; 32 bit) over the bits of every
//! constant.

use crate::damper::Scalars;
use crate::math::Real;
#[cfg(feature = "builder")]
use crate::table::{Piece, Table};

/// Hash of nothing.
pub(crate) const START: u32 = 0x811c_9dc5;

/// `hash` continued over the bits of constants, zero-extended.
pub(crate) fn of_words(hash: u32, words: impl Iterator<Item = u64>) -> u32 {
    words.flat_map(u64::to_le_bytes).fold(hash, |hash, byte| {
        (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
    })
}

/// Hash of two tables.
#[cfg(feature = "builder")]
pub(crate) fn of_tables<T: Real>(stage: &Table<Piece<T>>, output: &Table<[T; 4]>) -> u32 {
    let stage = stage
        .iter()
        .flat_map(|piece| piece.flow.iter().chain(&piece.potential));
    let coefficients = stage.chain(output.iter().flatten());
    of_words(START, coefficients.map(|value| value.to_bits_u64()))
}

/// Hash of a damper: its tables' and its scalars', never 0.
pub(crate) fn of_damper<T: Real>(tables: u32, scalars: &Scalars<T>) -> u32 {
    let scalars = scalars.as_array();
    of_words(tables, scalars.iter().map(|value| value.to_bits_u64())).max(1)
}
