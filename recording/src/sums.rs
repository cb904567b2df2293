//! SHA-256 of the numbers of each column, in the metadata of Parquet files that Dashpot writes: a changed byte of a
//! number is found when the column is read. Files of other programs have none.

use std::collections::BTreeMap;

use parquet::file::metadata::KeyValue;
use sha2::{Digest, Sha256};

/// Key of the metadata: an object of JSON with the sum of each column of numbers, hexadecimal, by the column's name.
pub(crate) const SUMS: &str = "dashpot_sha256";

/// Numbers that are hashed at a time.
const NUMBERS: usize = 64;

/// SHA-256 of the numbers of a column as float64 in little-endian bytes, a null being a NaN.
#[derive(Clone, Default)]
pub(crate) struct Sum(Sha256);

impl Sum {
    /// Takes in the next numbers of the column.
    pub(crate) fn add(&mut self, numbers: &[f64]) {
        let mut bytes = [[0; 8]; NUMBERS];
        for numbers in numbers.chunks(NUMBERS) {
            for (bytes, number) in bytes.iter_mut().zip(numbers) {
                *bytes = number.to_le_bytes();
            }
            self.0.update(bytes[..numbers.len()].as_flattened());
        }
    }

    /// The sum of all numbers, hexadecimal.
    pub(crate) fn text(&self) -> String {
        let bytes = self.0.clone().finalize();
        bytes.iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

/// The metadata that has the sums of these columns.
pub(crate) fn metadata<'a>(sums: impl Iterator<Item = (&'a str, &'a Sum)>) -> KeyValue {
    let sums: BTreeMap<&str, String> = sums.map(|(name, sum)| (name, sum.text())).collect();
    KeyValue::new(SUMS.into(), serde_json::json!(sums).to_string())
}
