//! Writes the recording, on a thread of its own: a slow disk holds nothing else up.

use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

use dashpot_live::SignalWords;
#[cfg(feature = "mdf")]
pub(super) use dashpot_recording::writer::GrowingMdf;

use super::recorded::RecordingState;
use crate::commands::failure::Outcome;

/// Rows of one run.
pub(super) struct Block {
    /// Number of the run.
    pub epoch: u32,
    pub rows: u64,
    pub bytes: Vec<u8>,
}

/// A recording.
pub(super) struct Recorder {
    path: PathBuf,
    names: Vec<String>,
    epoch: u32,
    file: GrowingMdf,
}

impl Recorder {
    /// Creates the file; `names` are those of the signals, the time first.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn new(path: &Path, names: &[String]) -> Outcome<Self> {
        Ok(Self {
            path: path.to_owned(),
            names: names.to_vec(),
            epoch: 1,
            file: create(path, names)?,
        })
    }

    /// Writes blocks until their sender is gone, or the file cannot be written.
    pub fn run(mut self, blocks: &Receiver<Block>, state: &RecordingState) {
        for block in blocks {
            match self.write(&block) {
                Ok(()) => state.add(block.rows),
                Err(error) => {
                    state.fail(error.to_string());
                    state.leave_out(block.rows);
                }
            }
        }
    }

    fn write(&mut self, block: &Block) -> Outcome<()> {
        if block.epoch != self.epoch {
            // Each run begins at the time zero, so it has a file of its own.
            self.file = create(&path_of(&self.path, block.epoch), &self.names)?;
            self.epoch = block.epoch;
        }
        Ok(self.file.append(&block.bytes)?)
    }
}

fn create(path: &Path, names: &[String]) -> Outcome<GrowingMdf> {
    let units = names.iter().map(|name| SignalWords::of(name).unit());
    let columns = names.iter().map(String::as_str).zip(units);
    let columns: Vec<(&str, &str)> = columns.collect();
    Ok(GrowingMdf::create(path, &columns)?)
}

/// File of a run: `run.mf4`, then `run-2.mf4` and so on.
fn path_of(first: &Path, epoch: u32) -> PathBuf {
    let mut name = first.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{epoch}.mf4"));
    first.with_file_name(name)
}

/// Stands in for the recording in a build without MDF4, which refuses `--record`.
#[cfg(not(feature = "mdf"))]
pub(super) enum GrowingMdf {}

#[cfg(not(feature = "mdf"))]
impl GrowingMdf {
    fn create(path: &Path, _: &[(&str, &str)]) -> Result<Self, dashpot_files::FileError> {
        let error = std::io::Error::from(std::io::ErrorKind::Unsupported);
        Err(dashpot_files::output::cannot_write(path, error))
    }

    fn append(&mut self, _: &[u8]) -> Result<(), dashpot_files::FileError> {
        match *self {}
    }

    pub fn add_row(_: f64, _: &[f32], _: &mut Vec<u8>) {}
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::path_of;

    #[test]
    fn later_runs_are_beside_the_first() {
        assert_eq!(path_of(Path::new("a/run.mf4"), 2), Path::new("a/run-2.mf4"));
    }
}
