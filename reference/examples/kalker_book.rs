//! Writes the tables of `dashpot_rail::creep::KalkerBook` and their provenance: `cargo xtask kalker-book`.

use std::error::Error;
use std::path::Path;

use dashpot_reference::kalker_book::{coefficients, provenance};

fn main() -> Result<(), Box<dyn Error>> {
    let coefficients = coefficients(|done, total| {
        if done % 50 == 0 || done == total {
            eprintln!("{done} of {total} directions of creepage");
        }
    })?;
    let bytes: Vec<u8> = coefficients
        .iter()
        .flatten()
        .flat_map(|number| number.to_le_bytes())
        .collect();
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rail/data");
    std::fs::write(data.join("kalker_book.bin"), &bytes)?;
    std::fs::write(data.join("kalker_book.txt"), provenance(&bytes))?;
    Ok(())
}
