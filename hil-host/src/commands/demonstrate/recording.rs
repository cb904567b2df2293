//! The shipped recording on a tick grid.

use std::path::Path;

use crate::error::Outcome;
use crate::files::recording::{Recording, Sample};
use crate::study::replay::Ticks;

const NAME: &str = "data/excitations/ride_made.csv";
const RIDE: &[u8] = include_bytes!("../../../../data/excitations/ride_made.csv");

fn open() -> Outcome<Recording> {
    Recording::read(Path::new(NAME), Box::new(RIDE))
}

/// Rows of the shipped recording.
///
/// # Errors
/// The file in the program is not as it was shipped.
pub fn shipped() -> Outcome<Vec<Sample>> {
    open()?.read_all()
}

/// Displacements (m) at ticks of `step_s` (s), linear between samples.
///
/// # Errors
/// As [`shipped`].
pub fn at_ticks(step_s: f64) -> Outcome<Vec<f64>> {
    Ticks::new(open()?, step_s)?.displacements_m()
}
