//! Reading of recorded loops.

use std::path::Path;

use dashpot_calibration::Recorded;
use dashpot_files::FileError;
use dashpot_files::input;
use dashpot_recording::{Channels, Gaps, Measurement};

/// Reads the recorded loops from the file at `path` and returns them with the gaps in the recording.
///
/// # Errors
/// The file cannot be read, or a channel is missing.
pub(super) fn read(path: &Path, channels: &Channels) -> Result<(Recorded, Gaps), FileError> {
    let mut measurement = Measurement::open(path, channels)?;
    let mut recorded = Recorded {
        name: input::name(path).file_name().map_or_else(
            || path.display().to_string(),
            |name| name.to_string_lossy().into_owned(),
        ),
        ..Recorded::default()
    };
    while let Some(sample) = measurement.next_sample()? {
        recorded.times_s.push(sample.time_s);
        recorded.displacements_m.push(sample.displacement_m);
        recorded.forces_n.push(sample.force_n);
    }
    Ok((recorded, measurement.gaps()))
}
