//! The shipped recording on a tick grid.

use std::path::Path;

use crate::failure::Outcome;
use crate::recording::{Recording, Sample};
use crate::replay::Ticks;

const NAME: &str = "data/excitations/ride_made.csv";
const RIDE: &[u8] = include_bytes!("../../../data/excitations/ride_made.csv");

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

/// Times (s) from the first sample and displacements (m) at ticks of `step_s`, linear between samples.
///
/// # Errors
/// As [`shipped`].
pub fn at_ticks(step_s: f64) -> Outcome<(Vec<f64>, Vec<f64>)> {
    let mut ticks = Ticks::new(open()?, step_s)?;
    let mut displacements_m = Vec::new();
    while let Some(tick) = ticks.next_tick()? {
        displacements_m.push(tick.displacement_m);
    }
    let times_s = (0..displacements_m.len())
        .map(|tick| tick as f64 * step_s)
        .collect();
    Ok((times_s, displacements_m))
}
