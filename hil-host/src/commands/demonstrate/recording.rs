//! The built-in recording, resampled to ticks.

use std::path::Path;

use dashpot_files::FileError;
use dashpot_recording::tick_grid::TickGrid;
use dashpot_recording::{Recording, Sample};

const NAME: &str = "data/excitations/ride_made.csv";
const RIDE: &[u8] = include_bytes!("../../../data/excitations/ride_made.csv");

fn open() -> Result<Recording, FileError> {
    Recording::read(Path::new(NAME), Box::new(RIDE))
}

/// Returns the samples of the built-in recording.
///
/// # Errors
/// The file built into the program is damaged.
pub fn shipped() -> Result<Vec<Sample>, FileError> {
    open()?.read_all()
}

/// Returns displacements (m) at ticks of `step_s` (s), interpolated linearly between samples.
///
/// # Errors
/// See [`shipped`].
pub fn at_ticks(step_s: f64) -> Result<Vec<f64>, FileError> {
    TickGrid::new(open()?, step_s)?.displacements_m()
}
