//! An MDF4 file that can be read at any time while it grows, even after its writer was killed.
//!
//! The rows are in one data block at the end of the file. A block of rows is written behind it first, then the length
//! of the data block is set, and then the number of rows. Whoever reads in between finds the rows before: what lies
//! behind the data block, or behind the last row in it, does not count.

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::mdf_head::{Head, Width};
use dashpot_files::FileError;
use dashpot_files::output::cannot_write;

/// An MDF4 file with a time in double precision and other channels in single precision.
///
/// ```
/// use dashpot_recording::writer::GrowingMdf;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("run.mf4");
/// let mut file = GrowingMdf::create(&path, &[("time_s", "s"), ("force_n", "N")])?;
/// let mut block = Vec::new();
/// GrowingMdf::add_row(0.0, &[1250.5], &mut block);
/// GrowingMdf::add_row(0.1, &[-980.0], &mut block);
/// file.append(&block)?;
/// // From here on the rows are in the file, whatever happens to this program.
/// assert_eq!(file.rows(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct GrowingMdf {
    path: PathBuf,
    file: File,
    head: Head,
    rows: u64,
}

impl GrowingMdf {
    /// Creates the file without rows, in place of one that exists; `columns` are names and units, the time first.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn create(path: &Path, columns: &[(&str, &str)]) -> Result<Self, FileError> {
        let failed = |error: io::Error| cannot_write(path, error);
        let head = Head::new(columns.iter().copied(), Width::Single).map_err(failed)?;
        let mut file = File::create(path).map_err(failed)?;
        file.write_all(head.bytes()).map_err(failed)?;
        Ok(Self {
            path: path.to_owned(),
            file,
            head,
            rows: 0,
        })
    }

    /// Adds a row to a block of rows.
    pub fn add_row(time_s: f64, values: &[f32], block: &mut Vec<u8>) {
        block.extend(time_s.to_le_bytes());
        for value in values {
            block.extend(value.to_le_bytes());
        }
    }

    /// Appends a block of whole rows.
    ///
    /// # Errors
    /// The file cannot be written; then it has the rows before.
    pub fn append(&mut self, block: &[u8]) -> Result<(), FileError> {
        self.write(block)
            .map_err(|error| cannot_write(&self.path, error))
    }

    fn write(&mut self, block: &[u8]) -> io::Result<()> {
        let row_bytes = self.head.row_bytes();
        let end = self.head.bytes().len() as u64 + self.rows * row_bytes as u64;
        self.file.seek(SeekFrom::Start(end))?;
        self.file.write_all(block)?;
        let rows = self.rows + (block.len() / row_bytes) as u64;
        for (at, number) in self.head.fields(rows) {
            self.file.seek(SeekFrom::Start(at))?;
            self.file.write_all(&number.to_le_bytes())?;
        }
        self.rows = rows;
        Ok(())
    }

    /// Rows in the file.
    pub fn rows(&self) -> u64 {
        self.rows
    }
}

#[cfg(test)]
mod tests {
    use std::fs::OpenOptions;
    use std::io::Write;
    use std::path::Path;

    use super::GrowingMdf;
    use crate::{Channels, overview};

    fn block(times: std::ops::Range<u32>) -> Vec<u8> {
        let mut block = Vec::new();
        for time in times {
            GrowingMdf::add_row(f64::from(time), &[1.5 * time as f32], &mut block);
        }
        block
    }

    /// Rows, and the last number of the last channel.
    fn read(path: &Path) -> (u64, Option<f64>) {
        let found = overview(path, &Channels::default()).unwrap();
        let last = found.channels.last().unwrap();
        (last.rows, last.last)
    }

    #[test]
    fn a_writer_killed_at_any_moment_leaves_the_rows_before() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.mf4");
        let columns = [("time_s", "s"), ("force_n", "N")];
        let mut file = GrowingMdf::create(&path, &columns).unwrap();
        file.append(&block(0..3)).unwrap();
        assert_eq!(read(&path), (3, Some(3.0)));
        // Killed within the next rows, and behind them.
        let next = block(3..5);
        for part in [&next[..7], &next[7..]] {
            let mut end = OpenOptions::new().append(true).open(&path).unwrap();
            end.write_all(part).unwrap();
            assert_eq!(read(&path), (3, Some(3.0)));
        }
        // Killed before the rows are counted.
        let [(at, length), _] = file.head.fields(5);
        let mut bytes = std::fs::read(&path).unwrap();
        let at = at as usize;
        bytes[at..at + 8].copy_from_slice(&length.to_le_bytes());
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(read(&path), (3, Some(3.0)));
        // And without all that.
        file.append(&next).unwrap();
        assert_eq!(read(&path), (5, Some(6.0)));
    }

    #[test]
    fn a_file_without_rows_is_whole_and_refused_as_empty() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.mf4");
        let file = GrowingMdf::create(&path, &[("time_s", "s"), ("force_n", "N")]).unwrap();
        assert_eq!(file.rows(), 0);
        let refused = overview(&path, &Channels::default()).unwrap_err();
        assert!(refused.to_string().contains("row"), "{refused}");
    }
}
