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

/// Hash of two tables.
#[cfg(feature = "builder")]
pub(crate) fn of_tables<T: Real>(stage: &Table<Piece<T>>, output: &Table<[T; 4]>) -> u32 {
    let stage = stage
        .iter()
        .flat_map(|piece| piece.flow.iter().chain(&piece.potential));
    stage
        .chain(output.iter().flatten())
        .fold(0x811c_9dc5, |hash, value| absorb(hash, *value))
}

/// Hash of a damper: its tables' and its scalars', never 0.
pub(crate) fn of_damper<T: Real>(tables: u32, scalars: &Scalars<T>) -> u32 {
    scalars
        .as_array()
        .iter()
        .fold(tables, |hash, value| absorb(hash, *value))
        .max(1)
}
