//! The shipped recording on a tick grid.

use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::tick_grid::TickGrid;
use dashpot_recording::{Recording, Sample};

const NAME: &str = "data/excitations/ride_made.csv";
const RIDE: &[u8] = include_bytes!("../../../../data/excitations/ride_made.csv");

fn open() -> Result<Recording, FileError> {
    Recording::read(Path::new(NAME), Box::new(RIDE))
}

/// Rows of the shipped recording.
///
/// # Errors
/// The file in the program is not as it was shipped.
pub fn shipped() -> Result<Vec<Sample>, FileError> {
    open()?.read_all()
}

/// Displacements (m) at ticks of `step_s` (s), linear between samples.
///
/// # Errors
/// As [`shipped`].
pub fn at_ticks(step_s: f64) -> Result<Vec<f64>, FileError> {
    TickGrid::new(open()?, step_s)?.displacements_m()
}
