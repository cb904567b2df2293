//! Track files: TOML in SI units, unknown keys refused with the nearest one.

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

/// Tracks that ship with the program: name and file.
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
    what: "track",
    one: "track",
    texts: &TRACKS,
};

/// What a track file gives: all but the irregularity, which [`TrackParameters::build`] generates or reads.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrackParameters {
    /// Name.
    pub name: String,
    /// Curvature and cant.
    pub layout: Layout,
    /// Where the irregularity is from.
    pub irregularity: IrregularityParameters,
    /// Single defects.
    pub defects: Vec<Defect>,
    /// What stands for the file in errors, and the line of its irregularity.
    file: PathBuf,
    irregularity_line: u64,
}

impl TrackParameters {
    /// The track, with its irregularity generated or read: some 30 ms for a kilometre of a spectrum.
    ///
    /// # Errors
    /// A spectrum that cannot be generated with what the file says of it, a measured file that cannot be read or used; with file and line.
    pub fn build(&self) -> Result<Track, FileError> {
        Track::new(
            self.layout.clone(),
            self.irregularity()?,
            self.defects.clone(),
        )
        .map_err(|error| self.in_irregularity(error))
    }

    /// The same with its irregularity as [`Self::build`] has it, which needs no other file and is written by serde.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn given(&self) -> Result<Self, FileError> {
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

    /// The same with an irregularity of another seed; none where it is not generated.
    pub fn with_seed(&self, seed: u64) -> Option<Self> {
        let mut other = self.clone();
        let IrregularityParameters::Generated {
            seed: of_file,
            generation,
            ..
        } = &mut other.irregularity
        else {
            return None;
        };
        *of_file = seed;
        generation.seeds = seed.into();
        Some(other)
    }

    fn in_irregularity(&self, error: impl Into<Box<dyn Error + Send + Sync>>) -> FileError {
        FileError::in_line(&self.file, self.irregularity_line, error)
    }
}

/// The track called `name`: a shipped one, or the TOML file at that path, `-` being standard input. A measured irregularity is read from
/// a file whose name counts from the track file.
///
/// # Errors
/// Neither track nor readable file; text that is no TOML; unknown or missing keys; parts or defects that are no track.
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

/// The track written in `text`; `name` stands for it in errors, and files that it names count from `folder`.
///
/// # Errors
/// As [`load`].
pub fn parse(name: &str, text: &str, folder: &Path) -> Result<TrackParameters, TrackFileError> {
    let tables: TrackTables = toml::from_str(text).map_err(|error| TrackFileError::Text {
        name: name.to_owned(),
        message: explain(&error),
    })?;
    Ok(tables.parameters(Path::new(name), text, folder)?)
}
