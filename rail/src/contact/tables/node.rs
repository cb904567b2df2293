//! One node of the tables: the patches of one pose.

use wide::f32x4;

use super::patch::{NUMBERS, TabulatedPatch};
use crate::contact::zones::ZONES;

/// Vectors of four numbers of one patch.
pub(super) const QUADS: usize = NUMBERS / 4;

/// Interpenetrations of all patches, which decide what is loaded, then the numbers of each patch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Node {
    /// In double precision: a contact of 1e9 N/m answers an error in the seventh digit with a tenth of a newton.
    pub interpenetrations: [f64; ZONES],
    pub numbers: [[f32x4; QUADS]; ZONES],
}

/// Bytes of a node in a file.
pub(super) const NODE_BYTES: usize = 8 * ZONES + 4 * ZONES * NUMBERS;

impl Node {
    pub fn new(patches: [TabulatedPatch; ZONES]) -> Self {
        Self {
            interpenetrations: patches.map(|patch| patch.interpenetration_m),
            numbers: patches.map(|patch| {
                let numbers = patch.to_numbers().map(|number| number as f32);
                let (quads, _) = numbers.as_chunks::<4>();
                std::array::from_fn(|quad| f32x4::from(quads[quad]))
            }),
        }
    }

    /// Appends the node in little-endian numbers.
    pub fn write(&self, bytes: &mut Vec<u8>) {
        for number in self.interpenetrations {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        let quads = self.numbers.as_flattened().iter();
        for number in quads.flat_map(|quad| quad.to_array()) {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
    }

    /// The node that [`Node::write`] has written into `bytes`.
    pub fn read(bytes: &[u8; NODE_BYTES]) -> Self {
        let (doubles, singles) = bytes.split_at(8 * ZONES);
        let (doubles, _) = doubles.as_chunks::<8>();
        let (singles, _) = singles.as_chunks::<4>();
        let quad = |first: usize| {
            f32x4::from(std::array::from_fn(|i| {
                f32::from_le_bytes(singles[first + i])
            }))
        };
        Self {
            interpenetrations: std::array::from_fn(|zone| f64::from_le_bytes(doubles[zone])),
            numbers: std::array::from_fn(|zone| {
                std::array::from_fn(|i| quad(NUMBERS * zone + 4 * i))
            }),
        }
    }
}
