//! A number that tells built dampers apart: FNV-1a (Fowler, Noll, Vo; 32 bit) over the bits of every
//! constant.

use crate::damper::Scalars;
use crate::math::Real;
#[cfg(feature = "builder")]
use crate::table::{Piece, Table};

fn absorb<T: Real>(hash: u32, value: T) -> u32 {
    let bytes = value.to_bits_u64().to_le_bytes();
    bytes.iter().fold(hash, |hash, byte| {
        (hash ^ u32::from(*byte)).wrapping_mul(0x0100_0193)
    })
}

/// Hash of a table.
#[cfg(feature = "builder")]
pub(crate) fn of_table<T: Real>(table: &Table<T>) -> u32 {
    let numbers = table.iter().flat_map(Piece::numbers);
    numbers.fold(0x811c_9dc5, |hash, value| absorb(hash, *value))
}

/// Hash of a damper: its table's and its scalars', never 0.
pub(crate) fn of_damper<T: Real>(table: u32, scalars: &Scalars<T>) -> u32 {
    scalars
        .as_array()
        .iter()
        .fold(table, |hash, value| absorb(hash, *value))
        .max(1)
}
