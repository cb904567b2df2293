//! The tests as files have them.

use std::path::Path;

use crate::files::FileError;
use crate::files::input;
use crate::files::recording::{Channels, Measurement};
use crate::study::calibration::{IndexTest, Recorded};

/// The loops recorded in the file at `path`.
///
/// # Errors
/// A file that cannot be read, or that has not the channels.
pub(super) fn recorded(path: &Path, channels: &Channels) -> Result<Vec<Recorded>, FileError> {
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
    Ok(vec![recorded])
}

/// The tests in the table of indices at `path`.
///
/// # Errors
/// A file that cannot be read, or that is no such table; with the line.
pub(super) fn indices(path: &Path) -> Result<Vec<IndexTest>, FileError> {
    let text = input::read_text(path)?;
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let rows: Result<Vec<IndexTest>, csv::Error> = reader.deserialize().collect();
    let rows = rows.map_err(|error| FileError::in_file(path, error))?;
    if rows.is_empty() {
        let message = csv::Error::from(std::io::Error::other("no row below the header"));
        return Err(FileError::in_file(path, message));
    }
    Ok(rows)
}
