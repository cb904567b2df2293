//! Study files: parameter sweeps over cases, and the figures drawn from their results.

mod axis;
mod error;
mod figure;
mod tables;
mod vary;

pub use axis::{Axis, Value, format_number};
pub use error::StudyFileError;
pub use figure::{Figure, FigureContent};
use tables::StudyTables;

use crate::case::CaseOptions;
use crate::overrides::explain;
use crate::shipped::{Found, Shipped};

/// Built-in studies: name and text.
pub const STUDIES: [(&str, &str); 8] = [
    ("paper", include_str!("../../data/studies/paper.toml")),
    (
        "curve-r600",
        include_str!("../../data/studies/curve-r600.toml"),
    ),
    (
        "stand-ins",
        include_str!("../../data/studies/stand-ins.toml"),
    ),
    (
        "out-of-service",
        include_str!("../../data/studies/out-of-service.toml"),
    ),
    ("hunting", include_str!("../../data/studies/hunting.toml")),
    ("damping", include_str!("../../data/studies/damping.toml")),
    (
        "temperature",
        include_str!("../../data/studies/temperature.toml"),
    ),
    (
        "worn-damper",
        include_str!("../../data/studies/worn-damper.toml"),
    ),
];

const SHIPPED: Shipped = Shipped {
    kind: "study",
    built_in: "study",
    texts: &STUDIES,
};

/// Study as read from its file.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyParameters {
    /// Name.
    pub name: String,
    /// Names of the indices in each row of results.
    pub observed: Vec<String>,
    /// Line of `observed` in the file.
    pub observed_line: u64,
    /// Sweeps, in the order in which their cases are numbered.
    pub sweeps: Vec<Sweep>,
    /// Figures of the page.
    pub figures: Vec<Figure>,
    /// Name of the file in error messages.
    pub file: String,
}

/// A case with varied parameters: it runs with each combination of the values of all axes, and each combination with
/// each seed.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Name, unique in the study.
    pub name: String,
    /// Title in figures.
    pub title: String,
    /// The case that the axes modify.
    pub case: CaseOptions,
    /// Varied parameters; the last axis varies fastest.
    pub axes: Vec<Axis>,
    /// Seeds of the track irregularity; if empty, the seed of the track file is used.
    pub seeds: Vec<u64>,
    /// Line in the file.
    pub line: u64,
}

impl StudyParameters {
    /// Loads the study called `name`: a built-in one, or the TOML file at that path (`-` for standard input).
    ///
    /// File names in it are relative to the study file; file names within `set` are relative to the working directory.
    ///
    /// # Errors
    /// Returns an error with file and line if there is no such study or readable file, if the text is not TOML, for
    /// unknown or missing keys, an axis without values, or a duplicate or unknown name.
    ///
    /// ```
    /// let study = dashpot_files::study::StudyParameters::load("paper")?;
    /// let clearance = study.sweeps.iter().find(|sweep| sweep.name == "12d").unwrap();
    /// assert_eq!(clearance.axes[0].parameter, "vertical.mount.clearance_m");
    /// assert_eq!(clearance.seeds.len(), 8);
    /// # Ok::<(), dashpot_files::study::StudyFileError>(())
    /// ```
    pub fn load(name: &str) -> Result<Self, StudyFileError> {
        Self::parse_in(&SHIPPED.find::<StudyFileError>(name)?)
    }

    /// Parses the study in `text`; error messages call it `name`.
    ///
    /// # Errors
    /// Same errors as [`Self::load`].
    pub fn parse(name: &str, text: &str) -> Result<Self, StudyFileError> {
        Self::parse_in(&Found {
            name: name.to_owned(),
            text: text.to_owned().into(),
            folder: std::path::PathBuf::new(),
        })
    }

    fn parse_in(found: &Found) -> Result<Self, StudyFileError> {
        let tables: StudyTables =
            toml::from_str(&found.text).map_err(|error| StudyFileError::Text {
                name: found.name.clone(),
                message: explain(&error),
            })?;
        tables.parameters(found)
    }

    /// Replaces the seeds with 1 to `count` in each sweep that has seeds.
    #[must_use]
    pub fn with_seeds(mut self, count: u64) -> Self {
        for sweep in &mut self.sweeps {
            if !sweep.seeds.is_empty() {
                sweep.seeds = (1..=count).collect();
            }
        }
        self
    }

    /// Returns the sweep called `name`.
    pub fn sweep(&self, name: &str) -> Option<&Sweep> {
        self.sweeps.iter().find(|sweep| sweep.name == name)
    }
}

impl Sweep {
    /// Number of combinations of the values of all axes.
    pub fn points(&self) -> u64 {
        let counts = self.axes.iter().map(|axis| axis.values.len() as u64);
        counts.fold(1, u64::saturating_mul)
    }

    /// Returns the value of each axis at a point; points are combinations of values, counted from 0.
    pub fn values(&self, point: u64) -> Vec<&Value> {
        let mut rest = point;
        let mut values: Vec<&Value> = Vec::with_capacity(self.axes.len());
        for axis in self.axes.iter().rev() {
            let count = axis.values.len() as u64;
            values.push(&axis.values[(rest % count) as usize]);
            rest /= count;
        }
        values.reverse();
        values
    }

    /// Returns the case with each axis set to a value.
    ///
    /// # Errors
    /// Returns an error message for an unknown parameter or a value of the wrong kind.
    pub fn options(&self, values: &[&Value]) -> Result<CaseOptions, String> {
        let mut options = self.case.clone();
        for (axis, value) in self.axes.iter().zip(values) {
            axis.apply(&mut options, value)
                .map_err(|reason| format!("{}: {reason}", axis.parameter))?;
        }
        Ok(options)
    }

    /// Number of cases: one per point and seed.
    pub fn cases(&self) -> u64 {
        self.points().saturating_mul(self.seeds.len().max(1) as u64)
    }
}
