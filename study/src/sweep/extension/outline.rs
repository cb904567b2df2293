//! Outline of a study: its lists of seeds and values, and its cases by parts.

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::parts::parts;
use crate::sweep::digest::Digest;
use crate::sweep::study::Study;
use dashpot_files::FileError;
use dashpot_files::study::{Axis, StudyFileError, StudyParameters, Sweep, Value};

/// Outline of a study, as kept beside its rows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// Digest of the study.
    pub digest: String,
    /// Names of the observed indices.
    pub observed: Vec<String>,
    /// Sweeps, in the order of the cases.
    pub sweeps: Vec<SweepOutline>,
}

/// Outline of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepOutline {
    /// Name.
    pub name: String,
    /// Seeds; empty for that of the track.
    pub seeds: Vec<u64>,
    /// Parts of the case with the first value of each axis and the first seed.
    pub parts: BTreeMap<String, String>,
    /// Varied parameters.
    pub axes: Vec<AxisOutline>,
}

/// Outline of an axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AxisOutline {
    /// Parameter.
    pub parameter: String,
    /// Overrides of a worn damper.
    pub set: Vec<String>,
    /// Values as text.
    pub values: Vec<String>,
    /// Digest of the case of each value, with the first value of the other axes.
    pub cases: Vec<String>,
}

impl Outline {
    /// Outlines a study.
    ///
    /// # Errors
    /// A file of the study has changed since it was loaded, and is invalid now.
    pub fn of(study: &Study) -> Result<Self, FileError> {
        let sweeps = study.parameters.sweeps.iter();
        let sweeps = sweeps.map(|sweep| {
            let outline = SweepOutline::of(study, sweep);
            let file = Path::new(&study.parameters.file);
            outline.map_err(|error| FileError::in_file(file, error))
        });
        Ok(Self {
            digest: study.digest().to_owned(),
            observed: study.parameters.observed.clone(),
            sweeps: sweeps.collect::<Result<_, _>>()?,
        })
    }

    /// Builds this outline's study from the sweeps of `study`, which has them with more seeds and values.
    ///
    /// # Errors
    /// Returns what `study` does not have of this outline.
    pub fn within(&self, study: &Study) -> Result<StudyParameters, String> {
        let sweeps = self.sweeps.iter();
        let sweeps = sweeps.map(|outline| match study.parameters.sweep(&outline.name) {
            Some(sweep) => outline
                .within(sweep)
                .map_err(|reason| format!("sweep {}: {reason}", sweep.name)),
            None => Err(format!("sweep {} is not in the study now", outline.name)),
        });
        Ok(StudyParameters {
            observed: self.observed.clone(),
            sweeps: sweeps.collect::<Result<_, _>>()?,
            figures: Vec::new(),
            ..study.parameters.clone()
        })
    }
}

impl SweepOutline {
    fn of(study: &Study, sweep: &Sweep) -> Result<Self, StudyFileError> {
        let first = sweep.values(0);
        let seed = sweep.seeds.first().copied();
        let mut axes = Vec::with_capacity(sweep.axes.len());
        for (index, axis) in sweep.axes.iter().enumerate() {
            let mut cases = Vec::with_capacity(axis.values.len());
            for value in &axis.values {
                let mut values = first.clone();
                values[index] = value;
                let mut digest = Digest::default();
                digest.add_case(&study.case_at(sweep, &values, seed)?)?;
                cases.push(digest.hexadecimal());
            }
            axes.push(AxisOutline {
                parameter: axis.parameter.clone(),
                set: axis.set.clone(),
                values: axis.values.iter().map(Value::to_string).collect(),
                cases,
            });
        }
        Ok(Self {
            name: sweep.name.clone(),
            seeds: sweep.seeds.clone(),
            parts: parts(&study.case_at(sweep, &first, seed)?)?,
            axes,
        })
    }

    /// Returns `sweep` with the seeds and values of this outline only.
    fn within(&self, sweep: &Sweep) -> Result<Sweep, String> {
        if self.seeds.is_empty() != sweep.seeds.is_empty() {
            let seed = |seeds: &[u64]| match seeds.is_empty() {
                true => "the seed of the track",
                false => "seeds of the study",
            };
            let [rows, now] = [&self.seeds, &sweep.seeds].map(|seeds| seed(seeds));
            return Err(format!("the rows have {rows}, the study now has {now}"));
        }
        if let Some(seed) = self.seeds.iter().find(|seed| !sweep.seeds.contains(seed)) {
            return Err(format!("seed {seed} is not in the study now"));
        }
        let parameters = |names: Vec<&str>| match names.is_empty() {
            true => "nothing".to_owned(),
            false => names.join(", "),
        };
        let own: Vec<&str> = self.axes.iter().map(|axis| &*axis.parameter).collect();
        let now: Vec<&str> = sweep.axes.iter().map(|axis| &*axis.parameter).collect();
        if own.len() != now.len() || own.iter().any(|name| !now.contains(name)) {
            let [own, now] = [own, now].map(parameters);
            return Err(format!("the rows vary {own}, the study now varies {now}"));
        }
        let mut axes = Vec::with_capacity(self.axes.len());
        for outline in &self.axes {
            let of_parameter = |axis: &&Axis| axis.parameter == outline.parameter;
            if let Some(axis) = sweep.axes.iter().find(of_parameter) {
                axes.push(outline.within(axis)?);
            }
        }
        Ok(Sweep {
            seeds: self.seeds.clone(),
            axes,
            ..sweep.clone()
        })
    }
}

impl AxisOutline {
    /// Returns `axis` with the values of this outline only.
    fn within(&self, axis: &Axis) -> Result<Axis, String> {
        let mut values = Vec::with_capacity(self.values.len());
        for text in &self.values {
            let found = axis.values.iter().find(|value| value.to_string() == *text);
            values.push(found.cloned().ok_or_else(|| {
                let parameter = &self.parameter;
                format!("value {text} of {parameter} is not in the study now")
            })?);
        }
        Ok(Axis {
            values,
            ..axis.clone()
        })
    }
}
