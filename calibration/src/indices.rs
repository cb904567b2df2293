//! Bench tests known only by their indices, read from a table.

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use dashpot_files::harmonic::Harmonic;
use dashpot_files::{FileError, input};
use dashpot_testbench::bench_test::Indices;

/// Default scatter of an index (%).
const DEFAULT_SCATTER_PERCENT: f64 = 1.0;

/// Indices of one harmonic test; `None` for those that were not measured. Forces are magnitudes.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct IndexTest {
    /// Amplitude (m).
    pub amplitude_m: f64,
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Maximum force in extension (N).
    #[serde(default)]
    pub max_extension_force_n: Option<f64>,
    /// Maximum force in compression (N).
    #[serde(default)]
    pub max_compression_force_n: Option<f64>,
    /// Energy dissipated per cycle (J).
    #[serde(default)]
    pub energy_per_cycle_j: Option<f64>,
    /// Upper bound of both forces (N).
    #[serde(default)]
    pub force_at_most_n: Option<f64>,
    /// Standard deviation of the indices (% of each value); 1 by default.
    #[serde(default)]
    pub scatter_percent: Option<f64>,
}

impl IndexTest {
    /// Reads the CSV table at `path`; its columns are the fields of this type.
    ///
    /// # Errors
    /// Returns an error, with the line, if the file cannot be read or is invalid.
    pub fn read(path: &Path) -> Result<Vec<Self>, FileError> {
        let text = input::read_text(path)?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let in_file = |error| FileError::in_file(path, error);
        let header = reader.headers().map_err(in_file)?.clone();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(in_file)?;
            let line = record.position().map_or(0, |from| line_of_row(&text, from));
            let row = record.deserialize(Some(&header));
            let row: Self = row.map_err(|error| in_cell(path, line, &header, error))?;
            row.check()
                .map_err(|reason| FileError::in_line(path, line, reason))?;
            rows.push(row);
        }
        if rows.is_empty() {
            let empty = csv::Error::from(io::Error::other("no row below the header"));
            return Err(FileError::in_file(path, empty));
        }
        Ok(rows)
    }

    /// Returns the motion of the test.
    pub fn motion(&self) -> Harmonic {
        Harmonic {
            amplitude_m: self.amplitude_m,
            frequency_hz: self.frequency_hz,
        }
    }

    /// Checks the values.
    ///
    /// # Errors
    /// Returns an error message for an invalid motion or index, or for a test without any index.
    pub(super) fn check(&self) -> Result<(), String> {
        self.motion().check().map_err(|error| error.to_string())?;
        let fields = [
            ("max_extension_force_n", self.max_extension_force_n),
            ("max_compression_force_n", self.max_compression_force_n),
            ("energy_per_cycle_j", self.energy_per_cycle_j),
            ("force_at_most_n", self.force_at_most_n),
            ("scatter_percent", self.scatter_percent),
        ];
        for (field, value) in fields {
            if let Some(value) = value.filter(|value| !(*value > 0.0 && value.is_finite())) {
                return Err(format!("{field}: {value}, allowed: above 0"));
            }
        }
        match self.count() {
            0 => Err("no index given".into()),
            _ => Ok(()),
        }
    }

    /// Returns the number of deviations.
    pub(super) fn count(&self) -> usize {
        let measured = [
            self.max_extension_force_n,
            self.max_compression_force_n,
            self.energy_per_cycle_j,
        ];
        let bounds = self.force_at_most_n.map_or(0, |_| 2);
        measured.iter().flatten().count() + bounds
    }

    /// Returns model minus measurement for each index, in standard deviations; for an upper bound, the excess over it.
    pub(super) fn deviations(&self, model: &Indices) -> impl Iterator<Item = f64> + use<> {
        let scatter = self.scatter_percent.unwrap_or(DEFAULT_SCATTER_PERCENT) * 1e-2;
        let (extension, compression) = (model.max_extension_force_n, model.max_compression_force_n);
        let measured = [
            (self.max_extension_force_n, extension),
            (self.max_compression_force_n, compression),
            (self.energy_per_cycle_j, model.energy_per_cycle_j),
        ];
        let with_bound = [extension, compression].map(|force| (self.force_at_most_n, force));
        let measured = measured.into_iter().filter_map(move |(index, value)| {
            let index = index?;
            Some((value - index) / (scatter * index.abs()))
        });
        measured.chain(with_bound.into_iter().filter_map(move |(bound, value)| {
            let bound = bound?;
            Some((value - bound).max(0.0) / (scatter * bound))
        }))
    }
}

/// Returns the line number of the first row at or after `from`, skipping comments and empty lines.
fn line_of_row(text: &str, from: &csv::Position) -> u64 {
    let rest = text.get(from.byte() as usize..).unwrap_or_default();
    let before = rest
        .lines()
        .take_while(|line| line.is_empty() || line.starts_with('#'));
    from.line() + before.count() as u64
}

/// Returns the error for an invalid cell.
fn in_cell(path: &Path, line: u64, header: &csv::StringRecord, error: csv::Error) -> FileError {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => {
            let column = err.field().and_then(|field| header.get(field as usize));
            match column {
                Some(column) => FileError::in_cell(path, line, column, err.kind().to_string()),
                None => FileError::in_line(path, line, err.kind().to_string()),
            }
        }
        _ => FileError::in_file(path, error),
    }
}
