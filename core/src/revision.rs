//! Revision of a damper: 32-bit FNV-1a hash (Fowler, Noll, Vo) of the bits of all constants.

use crate::real::Real;
use crate::scalars::Scalars;
#[cfg(feature = "builder")]
use crate::table::Table;

/// Initial value of the hash.
pub(crate) const START: u32 = 0x811c_9dc5;

/// Continues a hash with the bits of constants, each zero-extended to 64 bits.
pub(crate) fn of_words(hash: u32, words: impl Iterator<Item = u64>) -> u32 {
    words.fold(hash, of_word)
}

const PRIME: u32 = 0x0100_0193;

#[inline(never)] // one copy in flash
fn of_word(hash: u32, word: u64) -> u32 {
    let of_bytes = |hash, bytes: &[u8]| {
        bytes.iter().fold(hash, |hash: u32, byte| {
            (hash ^ u32::from(*byte)).wrapping_mul(PRIME)
        })
    };
    let bytes = word.to_le_bytes();
    if word >> 32 == 0 {
        // A zero byte only multiplies: these are the four high bytes of a number in single precision.
        const OF_ZEROS: u32 = PRIME.wrapping_pow(4);
        return of_bytes(hash, &bytes[..4]).wrapping_mul(OF_ZEROS);
    }
    of_bytes(hash, &bytes)
}

/// Hash of a table.
#[cfg(feature = "builder")]
pub(crate) fn of_table<T: Real>(table: &Table<T>) -> u32 {
    let numbers = table.built_numbers();
    of_words(START, numbers.map(|value| value.to_bits_u64()))
}

/// Hash of a damper, from the hash of its table and its scalars; never 0.
pub(crate) fn of_damper<T: Real>(table: u32, scalars: &Scalars<T>) -> u32 {
    let scalars = scalars.as_array();
    of_words(table, scalars.iter().map(|value| value.to_bits_u64())).max(1)
}
