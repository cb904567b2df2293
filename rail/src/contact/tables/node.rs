//! One node of the tables: the patches at one pose.

use crate::contact::tabulated_patch::{NUMBERS, TabulatedPatch};
use crate::contact::zones::ZONES;

/// The interpenetrations of all patches, which decide which of them carry load, and the packed numbers of each patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Node {
    /// In double precision: single precision would cause an error of a tenth of a newton in a contact of 1e9 N/m.
    pub interpenetrations: [f64; ZONES],
    pub numbers: [[f32; NUMBERS]; ZONES],
}

/// Bytes of a node in a file.
pub(super) const NODE_BYTES: usize = 8 * ZONES + 4 * ZONES * NUMBERS;

impl Node {
    pub fn new(patches: [TabulatedPatch; ZONES]) -> Self {
        Self {
            interpenetrations: patches.map(|patch| patch.interpenetration_m),
            numbers: patches.map(|patch| patch.to_numbers().to_array().map(|number| number as f32)),
        }
    }

    /// Appends the node to `bytes`, as little-endian numbers.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        for number in self.interpenetrations {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        for number in self.numbers.as_flattened() {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
    }

    /// Reads a node that was written by [`Node::write`].
    pub fn read(bytes: &[u8; NODE_BYTES]) -> Self {
        let (doubles, singles) = bytes.split_at(8 * ZONES);
        let (doubles, _) = doubles.as_chunks::<8>();
        let (singles, _) = singles.as_chunks::<4>();
        Self {
            interpenetrations: std::array::from_fn(|zone| f64::from_le_bytes(doubles[zone])),
            numbers: std::array::from_fn(|zone| {
                std::array::from_fn(|i| f32::from_le_bytes(singles[NUMBERS * zone + i]))
            }),
        }
    }
}
