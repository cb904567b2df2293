//! Numbered cases of a study.

use super::digest::Digest;
use super::observed::Observed;
use dashpot_files::case::{Case, CaseError};
use dashpot_files::did_you_mean;
use dashpot_files::study::{StudyFileError, StudyParameters, Sweep, Value};
use dashpot_vehicle_run::check_ride;

/// Maximum number of cases in a study.
const MAX_CASES: u64 = 10_000_000;

/// Study whose values have all been checked, and its list of cases.
#[derive(Debug, Clone)]
pub struct Study {
    /// Contents of the study file.
    pub parameters: StudyParameters,
    /// Observed indices, in the order of a row.
    pub observed: Vec<Observed>,
    /// Parameters that vary in any sweep, in the order of their first use.
    pub varied: Vec<String>,
    /// Number of the first case of each sweep, followed by the total number of cases.
    starts: Vec<u64>,
    /// Digest of the cases: 16 hexadecimal digits.
    digest: String,
}

/// Numbered case of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyCase<'a> {
    /// Number of the case, from 0.
    pub number: u64,
    /// Sweep that contains the case.
    pub sweep: &'a Sweep,
    /// Number of the combination of values within the sweep, from 0.
    pub point: u64,
    /// Seed of the track irregularity; `None` for that of the track file.
    pub seed: Option<u64>,
}

/// One of `count` parts of a study; contains every `count`-th case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Number of the shard, from 0.
    pub number: u64,
    /// Number of shards.
    pub count: u64,
}

impl Study {
    /// Checks every value of each axis once, with the other axes at their first value.
    ///
    /// # Errors
    /// Returns an error for an unknown index, for runs too short for an observed index, for an invalid value or case
    /// (with file and line), or for too many cases.
    ///
    /// ```
    /// use dashpot_files::study::StudyParameters;
    /// use dashpot_study::sweep::Study;
    /// let text = r#"
    /// name = "speed and clearance"
    /// observed = ["sperling_vertical"]
    /// [[sweep]]
    /// name = "both"
    /// case = "straight-180"
    /// seeds = [1, 2]
    /// vary = [
    ///   { parameter = "speed_km_h", values = [120, 180] },
    ///   { parameter = "vertical.mount.clearance_m", from = 1e-3, to = 3e-3, count = 3 },
    /// ]
    /// "#;
    /// let study = Study::new(StudyParameters::parse("study", text)?)?;
    /// assert_eq!(study.cases(), 2 * 3 * 2);
    /// let case = study.case(3).unwrap();
    /// assert_eq!(case.seed, Some(2));
    /// let values: Vec<String> = case.values().iter().map(|value| value.to_string()).collect();
    /// assert_eq!(values, ["120", "0.002"]);
    /// # Ok::<(), dashpot_files::study::StudyFileError>(())
    /// ```
    pub fn new(parameters: StudyParameters) -> Result<Self, StudyFileError> {
        let invalid = |line: u64, message: String| StudyFileError::Line {
            name: parameters.file.clone(),
            line,
            message,
        };
        let mut observed = Vec::new();
        for name in &parameters.observed {
            let found = Observed::by_name(name);
            let known = super::OBSERVED.iter().map(|index| index.name);
            observed.push(*found.ok_or_else(|| {
                let hint = did_you_mean(name, known.clone());
                let known = known.clone().collect::<Vec<_>>().join(", ");
                invalid(
                    parameters.observed_line,
                    format!("observed `{name}`: no such index{hint}; allowed: {known}"),
                )
            })?);
        }
        let mut digest = Digest::default();
        let mut varied: Vec<String> = Vec::new();
        let mut starts = vec![0_u64];
        for sweep in &parameters.sweeps {
            for axis in &sweep.axes {
                if !varied.contains(&axis.parameter) {
                    varied.push(axis.parameter.clone());
                }
            }
            let ride_index = observed.iter().find(|index| index.is_ride_index());
            check(&parameters, sweep, ride_index, &mut digest)?;
            let end = starts[starts.len() - 1].saturating_add(sweep.cases());
            if end > MAX_CASES {
                let message = format!(
                    "more than {MAX_CASES} cases in the sweeps up to {}",
                    sweep.name
                );
                return Err(invalid(sweep.line, message));
            }
            starts.push(end);
        }
        digest.add(&parameters.observed);
        Ok(Self {
            observed,
            varied,
            starts,
            digest: digest.hexadecimal(),
            parameters,
        })
    }

    /// Number of cases.
    pub fn cases(&self) -> u64 {
        self.starts[self.starts.len() - 1]
    }

    /// True if the files named by the study have not changed since it was loaded.
    ///
    /// # Errors
    /// Same errors as [`Self::new`].
    pub fn is_unchanged(&self) -> Result<bool, StudyFileError> {
        Ok(Self::new(self.parameters.clone())?.digest == self.digest)
    }

    /// Digest of the cases. Rows of studies with the same digest and version belong together.
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// Returns the case with a number; `None` beyond the last case.
    pub fn case(&self, number: u64) -> Option<StudyCase<'_>> {
        if number >= self.cases() {
            return None;
        }
        let sweep = self.starts.partition_point(|start| *start <= number) - 1;
        let within = number - self.starts[sweep];
        let sweep = &self.parameters.sweeps[sweep];
        let seeds = sweep.seeds.len().max(1) as u64;
        Some(StudyCase {
            number,
            sweep,
            point: within / seeds,
            seed: sweep.seeds.get((within % seeds) as usize).copied(),
        })
    }

    /// Returns the numbers of the cases at a point of a sweep, one case per seed.
    pub fn numbers(&self, sweep: &Sweep, point: u64) -> std::ops::Range<u64> {
        let sweeps = &self.parameters.sweeps;
        let index = sweeps.iter().position(|other| other.name == sweep.name);
        let seeds = sweep.seeds.len().max(1) as u64;
        let start = index.map_or(0, |index| self.starts[index]) + point * seeds;
        start..start + seeds
    }

    /// Returns the numbers of the cases of a shard, or of all cases if `shard` is `None`.
    pub fn part(&self, shard: Option<Shard>) -> impl Iterator<Item = u64> + use<> {
        let Shard { number, count } = shard.unwrap_or(Shard {
            number: 0,
            count: 1,
        });
        (number..self.cases()).step_by(usize::try_from(count).unwrap_or(usize::MAX))
    }

    /// Builds the vehicle case of a numbered case.
    ///
    /// # Errors
    /// Same errors as [`Self::case_at`].
    pub fn build(&self, case: &StudyCase<'_>) -> Result<Case, StudyFileError> {
        self.case_at(case.sweep, &case.values(), case.seed)
    }

    /// Builds the vehicle case of a sweep with one value per axis and a seed.
    ///
    /// # Errors
    /// Returns an error, with file and line, for an invalid value or case.
    pub fn case_at(
        &self,
        sweep: &Sweep,
        values: &[&Value],
        seed: Option<u64>,
    ) -> Result<Case, StudyFileError> {
        let file = &self.parameters.file;
        let case = build(file, sweep, values)?;
        match seed {
            Some(seed) => with_seed(file, sweep, case, seed),
            None => Ok(case),
        }
    }
}

impl Shard {
    /// True if the shard contains the case with this number.
    pub fn contains(self, case: u64) -> bool {
        case % self.count == self.number
    }
}

impl StudyCase<'_> {
    /// Returns the value of each axis of the sweep.
    pub fn values(&self) -> Vec<&Value> {
        self.sweep.values(self.point)
    }
}

/// Replaces the seed of the track irregularity.
fn with_seed(file: &str, sweep: &Sweep, case: Case, seed: u64) -> Result<Case, StudyFileError> {
    match case.track.with_seed(seed) {
        Some(track) => Ok(Case { track, ..case }),
        None => Err(StudyFileError::Line {
            name: file.to_owned(),
            line: sweep.line,
            message: format!(
                "sweep {}: seeds are given, but track {} has no irregularity generated from a spectrum; \
                 `seeds = []` in the sweep takes none",
                sweep.name, case.track.name
            ),
        }),
    }
}

/// Builds the case of a sweep with one value per axis.
fn build(file: &str, sweep: &Sweep, values: &[&Value]) -> Result<Case, StudyFileError> {
    let location = || {
        let pairs = sweep.axes.iter().zip(values);
        let pairs = pairs.map(|(axis, value)| format!("{} {value}", axis.parameter));
        match pairs.collect::<Vec<_>>().join(", ") {
            text if text.is_empty() => text,
            text => format!(" at {text}"),
        }
    };
    let options = sweep
        .options(values)
        .map_err(|message| StudyFileError::Line {
            name: file.to_owned(),
            line: sweep.line,
            message: format!("sweep {}: {message}", sweep.name),
        })?;
    options
        .case()
        .map_err(|source: CaseError| StudyFileError::Case {
            name: file.to_owned(),
            line: sweep.line,
            sweep: sweep.name.clone(),
            at: location(),
            source: Box::new(source),
        })
}

/// Checks a sweep by building cases that together contain each of its values; adds these cases to the digest.
fn check(
    study: &StudyParameters,
    sweep: &Sweep,
    ride_index: Option<&Observed>,
    digest: &mut Digest,
) -> Result<(), StudyFileError> {
    digest.add(&sweep.name);
    digest.add(&sweep.seeds);
    let first = sweep.values(0);
    let mut add = |values: &[&Value]| -> Result<(), StudyFileError> {
        let case = build(&study.file, sweep, values)?;
        let case = match sweep.seeds.first() {
            Some(seed) => with_seed(&study.file, sweep, case, *seed)?,
            None => case,
        };
        if let (Some(index), Err(reason)) = (ride_index, check_ride(&case)) {
            return Err(StudyFileError::Line {
                name: study.file.clone(),
                line: sweep.line,
                message: format!(
                    "sweep {}: observed `{}`: {reason}; allowed: a longer duration_s, or `observed` without this \
                     index",
                    sweep.name, index.name
                ),
            });
        }
        digest.add_case(&case)?;
        Ok(())
    };
    add(&first)?;
    for (index, axis) in sweep.axes.iter().enumerate() {
        for value in &axis.values[1..] {
            let mut values = first.clone();
            values[index] = value;
            add(&values)?;
        }
    }
    for axis in &sweep.axes {
        let values: Vec<String> = axis.values.iter().map(ToString::to_string).collect();
        digest.add(&(&axis.parameter, values, &axis.set));
    }
    Ok(())
}
