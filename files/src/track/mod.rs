//! Track files: TOML in SI units; unknown keys are errors that suggest a similar key.

mod defect;
mod error;
mod irregularity;
mod keys;
mod part;
mod tables;

use std::error::Error;
use std::path::{Path, PathBuf};

use dashpot_rail::track::{Defect, Irregularity, Layout, Track};
pub use error::TrackFileError;
pub use irregularity::IrregularityParameters;
use serde::{Deserialize, Serialize};
use tables::TrackTables;

use crate::FileError;
use crate::overrides::explain;
use crate::shipped::{Found, Shipped};

/// Built-in tracks: name and text.
pub const TRACKS: [(&str, &str); 7] = [
    ("ideal", include_str!("../../data/tracks/ideal.toml")),
    ("straight", include_str!("../../data/tracks/straight.toml")),
    (
        "straight-short",
        include_str!("../../data/tracks/straight-short.toml"),
    ),
    (
        "straight-german",
        include_str!("../../data/tracks/straight-german.toml"),
    ),
    (
        "curve-r200",
        include_str!("../../data/tracks/curve-r200.toml"),
    ),
    (
        "curve-r300",
        include_str!("../../data/tracks/curve-r300.toml"),
    ),
    (
        "curve-r600",
        include_str!("../../data/tracks/curve-r600.toml"),
    ),
];

const SHIPPED: Shipped = Shipped {
    kind: "track",
    built_in: "track",
    texts: &TRACKS,
};

/// Content of a track file; [`TrackParameters::build`] generates or reads the irregularity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrackParameters {
    /// Name.
    pub name: String,
    /// Curvature and cant.
    pub layout: Layout,
    /// Source of the irregularity.
    pub irregularity: IrregularityParameters,
    /// Single defects.
    pub defects: Vec<Defect>,
    /// Changes of the gauge along the track, `[distance, change]`, m; empty if it does not change.
    pub gauge_changes: Vec<[f64; 2]>,
    /// Factors on the friction coefficient along the track, `[distance, left, right]`; empty if they are 1.
    pub friction_ratios: Vec<[f64; 3]>,
    /// Name of the file in error messages.
    file: PathBuf,
    /// Line of the irregularity in the file.
    irregularity_line: u64,
}

impl TrackParameters {
    /// Builds the track and generates or reads its irregularity, which takes about 30 ms per generated kilometre.
    ///
    /// # Errors
    /// Returns an error with file and line if the irregularity cannot be generated, or if a measured file cannot be
    /// used.
    pub fn build(&self) -> Result<Track, FileError> {
        Track::new(
            self.layout.clone(),
            self.irregularity()?,
            self.defects.clone(),
        )
        .and_then(|track| track.with_gauge(&self.gauge_changes))
        .and_then(|track| track.with_friction(&self.friction_ratios))
        .map_err(|error| self.in_irregularity(error))
    }

    /// Returns the track with its irregularity already generated or read, so that it can be serialized and needs no
    /// other file.
    ///
    /// # Errors
    /// Same errors as [`Self::build`].
    pub fn resolved(&self) -> Result<Self, FileError> {
        Ok(Self {
            irregularity: IrregularityParameters::Given(self.irregularity()?),
            ..self.clone()
        })
    }

    fn irregularity(&self) -> Result<Irregularity, FileError> {
        match &self.irregularity {
            IrregularityParameters::None => Ok(Irregularity::default()),
            IrregularityParameters::Given(irregularity) => Ok(irregularity.clone()),
            IrregularityParameters::Generated { generation, .. } => generation
                .irregularity()
                .map_err(|error| self.in_irregularity(error)),
            IrregularityParameters::Measured { file, options } => {
                irregularity::read(file, options).map_err(|error| self.in_irregularity(error))
            }
        }
    }

    /// Returns the track with another seed; `None` if its irregularity is not generated.
    pub fn with_seed(&self, seed: u64) -> Option<Self> {
        let mut other = self.clone();
        let IrregularityParameters::Generated {
            seed: file_seed,
            generation,
            ..
        } = &mut other.irregularity
        else {
            return None;
        };
        *file_seed = seed;
        generation.seeds = seed.into();
        Some(other)
    }

    fn in_irregularity(&self, error: impl Into<Box<dyn Error + Send + Sync>>) -> FileError {
        FileError::in_line(&self.file, self.irregularity_line, error)
    }
}

/// Loads the track called `name`: a built-in one, or the TOML file at that path (`-` for standard input). The file name
/// of a measured irregularity is relative to the track file.
///
/// # Errors
/// Returns an error if there is no such track or readable file, if the text is not TOML, for unknown or missing keys,
/// and for invalid parts or defects.
///
/// ```
/// let track = dashpot_files::track::load("curve-r600")?.build()?;
/// assert_eq!(track.at(250.0).alignment.curvature_per_m, 1.0 / 600.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn load(name: &str) -> Result<TrackParameters, TrackFileError> {
    let Found { name, text, folder } = SHIPPED.find::<TrackFileError>(name)?;
    parse(&name, &text, &folder)
}

/// Parses the track in `text`; error messages call it `name`, and file names are relative to `folder`.
///
/// # Errors
/// Same errors as [`load`].
pub fn parse(name: &str, text: &str, folder: &Path) -> Result<TrackParameters, TrackFileError> {
    let tables: TrackTables = toml::from_str(text).map_err(|error| TrackFileError::Text {
        name: name.to_owned(),
        message: explain(&error),
    })?;
    Ok(tables.parameters(Path::new(name), text, folder)?)
}
