//! SHA-256 checksums of columns. Dashpot writes them to the metadata of Parquet files, so that a damaged number is
//! detected when the column is read. Files that other programs write have no such checksums.

use std::collections::BTreeMap;

use parquet::file::metadata::KeyValue;
use sha2::{Digest, Sha256};

/// Metadata key of the checksums: a JSON object that maps the name of each numeric column to a hexadecimal checksum.
pub(crate) const SUMS: &str = "dashpot_sha256";

/// Numbers hashed at a time.
const NUMBERS: usize = 64;

/// SHA-256 of the numbers of a column as little-endian float64; a null counts as NaN.
#[derive(Clone, Default)]
pub(crate) struct Sum(Sha256);

impl Sum {
    /// Adds the next numbers of the column.
    pub(crate) fn add(&mut self, numbers: &[f64]) {
        let mut bytes = [[0; 8]; NUMBERS];
        for numbers in numbers.chunks(NUMBERS) {
            for (bytes, number) in bytes.iter_mut().zip(numbers) {
                *bytes = number.to_le_bytes();
            }
            self.0.update(bytes[..numbers.len()].as_flattened());
        }
    }

    /// Returns the checksum of all numbers, hexadecimal.
    pub(crate) fn text(&self) -> String {
        dashpot_files::hexadecimal(&self.0.clone().finalize())
    }
}

/// Creates the metadata entry with the checksums of the columns.
pub(crate) fn metadata<'a>(sums: impl Iterator<Item = (&'a str, &'a Sum)>) -> KeyValue {
    let sums: BTreeMap<&str, String> = sums.map(|(name, sum)| (name, sum.text())).collect();
    KeyValue::new(SUMS.into(), serde_json::json!(sums).to_string())
}
