//! Study files: cases of a vehicle on a track whose parameters vary, and the figures drawn of them.

mod axis;
mod error;
mod figure;
mod tables;
mod vary;

pub use axis::{Axis, Value, shown};
pub use error::StudyFileError;
pub use figure::{Figure, Shown};
use tables::StudyTables;

use crate::case::CaseOptions;
use crate::overrides::explain;
use crate::shipped::{Found, Shipped};

/// Studies that ship with the program: name and file.
pub const STUDIES: [(&str, &str); 7] = [
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
    what: "study",
    one: "study",
    texts: &STUDIES,
};

/// A study as its file gives it.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyParameters {
    /// Name.
    pub name: String,
    /// Names of the indices of a row.
    pub observed: Vec<String>,
    /// Line of the observed in the file.
    pub observed_line: u64,
    /// Sweeps, in the order of their cases.
    pub sweeps: Vec<Sweep>,
    /// Figures of the page.
    pub figures: Vec<Figure>,
    /// What stands for the file in errors.
    pub file: String,
}

/// A case, and what varies of it: every combination of the values of all axes, each with every seed.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Name, which no other sweep of the study has.
    pub name: String,
    /// What a figure is called.
    pub title: String,
    /// The case that values are changed of.
    pub case: CaseOptions,
    /// What varies; the last axis varies fastest.
    pub axes: Vec<Axis>,
    /// Seeds of the irregularity; that of the track file when empty.
    pub seeds: Vec<u64>,
    /// Line in the file.
    pub line: u64,
}

impl StudyParameters {
    /// The study called `name`: a shipped one, or the TOML file at that path, `-` being standard input. Names of files in it count
    /// from the study file, those within `set` from the working folder.
    ///
    /// # Errors
    /// Neither study nor readable file; text that is no TOML; unknown or missing keys; axes without values, names that there are twice
    /// or not at all; with file and line.
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

    /// The study written in `text`; `name` stands for it in errors.
    ///
    /// # Errors
    /// As [`Self::load`].
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

    /// The same with seeds 1 to `count` where there are seeds.
    #[must_use]
    pub fn with_seeds(mut self, count: u64) -> Self {
        for sweep in &mut self.sweeps {
            if !sweep.seeds.is_empty() {
                sweep.seeds = (1..=count).collect();
            }
        }
        self
    }

    /// The sweep of a name.
    pub fn sweep(&self, name: &str) -> Option<&Sweep> {
        self.sweeps.iter().find(|sweep| sweep.name == name)
    }
}

impl Sweep {
    /// Combinations of the values of all axes.
    pub fn points(&self) -> u64 {
        let counts = self.axes.iter().map(|axis| axis.values.len() as u64);
        counts.fold(1, u64::saturating_mul)
    }

    /// The value of each axis at a point.
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

    /// The case with a value of each axis.
    ///
    /// # Errors
    /// As [`CaseOptions::case`]; a value of the wrong kind as well.
    pub fn options(&self, values: &[&Value]) -> Result<CaseOptions, String> {
        let mut options = self.case.clone();
        for (axis, value) in self.axes.iter().zip(values) {
            axis.apply(&mut options, value)
                .map_err(|reason| format!("{}: {reason}", axis.parameter))?;
        }
        Ok(options)
    }

    /// Cases: each point with every seed.
    pub fn cases(&self) -> u64 {
        self.points().saturating_mul(self.seeds.len().max(1) as u64)
    }
}
