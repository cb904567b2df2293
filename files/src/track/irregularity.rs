//! Sources of a track's irregularity.

use std::path::{Path, PathBuf};

use dashpot_rail::track::measured::{self, MeasuredTrackError, Options};
use dashpot_rail::track::{Band, Generation, Irregularity, Seeds, Spectrum};
use serde::{Deserialize, Serialize};

use crate::overrides::did_you_mean;
use crate::shipped::resolve_name;
use crate::{FileError, input};

/// Source of an irregularity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum IrregularityParameters {
    /// No irregularity.
    None,
    /// Already generated or read.
    Given(Irregularity),
    /// Generated from a published spectrum.
    #[serde(skip)]
    Generated {
        /// Name of the spectrum in the track file.
        spectrum: String,
        /// Seed in the track file.
        seed: u64,
        /// Settings of the generator.
        generation: Box<Generation>,
    },
    /// Read from a measured file.
    #[serde(skip)]
    Measured {
        /// The file.
        file: PathBuf,
        /// How the measurement is placed on the track.
        options: Options,
    },
}

/// Table of either a spectrum or a measured file; each has its own keys.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct IrregularityTable {
    spectrum: Option<String>,
    seed: Option<u64>,
    wavelength_m: Option<[f64; 2]>,
    length_m: Option<f64>,
    file: Option<String>,
    shift_m: Option<f64>,
    ramp_m: Option<f64>,
    spacing_m: Option<f64>,
}

/// Names of the spectra.
const SPECTRA: [&str; 8] = [
    "fra-1",
    "fra-2",
    "fra-3",
    "fra-4",
    "fra-5",
    "fra-6",
    "german-low",
    "german-high",
];

fn spectrum_called(name: &str) -> Result<Spectrum, String> {
    let class = name
        .strip_prefix("fra-")
        .and_then(|class| class.parse().ok());
    match (name, class) {
        ("german-low", _) => Ok(Spectrum::german_low()),
        ("german-high", _) => Ok(Spectrum::german_high()),
        (_, Some(class)) => Spectrum::fra(class).map_err(|error| error.to_string()),
        _ => Err(format!(
            "spectrum `{name}`, allowed: {}{}",
            SPECTRA.join(", "),
            did_you_mean(name, SPECTRA.into_iter())
        )),
    }
}

impl IrregularityTable {
    /// Converts the table; file names are relative to `folder`.
    ///
    /// # Errors
    /// Returns an error message that describes the problem.
    pub fn parameters(self, folder: &Path) -> Result<IrregularityParameters, String> {
        let spectrum_keys = [
            ("seed", self.seed.is_some()),
            ("wavelength_m", self.wavelength_m.is_some()),
            ("length_m", self.length_m.is_some()),
        ];
        match (self.spectrum, self.file) {
            (Some(spectrum), None) => {
                if self.shift_m.is_some() {
                    return Err("`shift_m` given with `spectrum`, allowed: with `file`".into());
                }
                let missing = |key| {
                    format!("missing `{key}`: a spectrum needs seed, wavelength_m and length_m")
                };
                let generation = Generation::new(spectrum_called(&spectrum)?);
                let seed = self.seed.ok_or_else(|| missing("seed"))?;
                let [shortest_m, longest_m] =
                    self.wavelength_m.ok_or_else(|| missing("wavelength_m"))?;
                let generation = generation
                    .with_band(Band::new(shortest_m, longest_m))
                    .with_seeds(Seeds::from(seed))
                    .with_length_m(self.length_m.ok_or_else(|| missing("length_m"))?)
                    .with_ramp_m(self.ramp_m.unwrap_or(generation.ramp_m))
                    .with_spacing_m(self.spacing_m);
                Ok(IrregularityParameters::Generated {
                    spectrum,
                    seed,
                    generation: Box::new(generation),
                })
            }
            (None, Some(file)) => {
                if let Some((key, _)) = spectrum_keys.into_iter().find(|(_, given)| *given) {
                    return Err(format!(
                        "`{key}` given with `file`, allowed: with `spectrum`"
                    ));
                }
                let options = Options::default();
                Ok(IrregularityParameters::Measured {
                    file: resolve_name(folder, &file).into(),
                    options: options
                        .with_shift_m(self.shift_m.unwrap_or(options.shift_m))
                        .with_ramp_m(self.ramp_m.unwrap_or(options.ramp_m))
                        .with_spacing_m(self.spacing_m),
                })
            }
            _ => Err("give either `spectrum` or `file`".into()),
        }
    }
}

/// Reads a measured irregularity.
pub(super) fn read(file: &Path, options: &Options) -> Result<Irregularity, FileError> {
    let text = input::read_text(file)?;
    let read = measured::parse(&text, options).map_err(|error| in_file(file, error))?;
    Ok(read.0)
}

fn in_file(file: &Path, error: MeasuredTrackError) -> FileError {
    match (error.line(), error.column().map(str::to_owned)) {
        (Some(line), Some(column)) => FileError::in_cell(file, line, column, error),
        (Some(line), None) => FileError::in_line(file, line, error),
        (None, _) => FileError::in_file(file, error),
    }
}
