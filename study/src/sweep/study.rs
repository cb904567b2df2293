//! The cases of a study, by their numbers.

use super::digest::Digest;
use super::observed::Observed;
use dashpot_files::case::{Case, CaseError};
use dashpot_files::did_you_mean;
use dashpot_files::study::{StudyFileError, StudyParameters, Sweep, Value};
use dashpot_vehicle_run::check_ride;

/// Most cases of a study.
const MOST_CASES: u64 = 10_000_000;

/// A study whose every value has been checked, and its list of cases.
#[derive(Debug, Clone)]
pub struct Study {
    /// What its file gives.
    pub parameters: StudyParameters,
    /// The indices of a row.
    pub observed: Vec<Observed>,
    /// Parameters that vary anywhere, in the order in which they are named.
    pub varied: Vec<String>,
    /// Number of the first case of each sweep, and of all cases.
    starts: Vec<u64>,
    /// Of what the cases are: 16 hexadecimal digits.
    digest: String,
}

/// A case of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StudyCase<'a> {
    /// Its number, from 0.
    pub number: u64,
    /// Its sweep.
    pub sweep: &'a Sweep,
    /// Number of its values among the combinations of the sweep, from 0.
    pub point: u64,
    /// Seed of its irregularity; that of the track file where there is none.
    pub seed: Option<u64>,
}

/// One of `of` parts of the cases, which takes every `of`-th.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Its number, from 0.
    pub number: u64,
    /// How many there are.
    pub of: u64,
}

impl Study {
    /// Checks every value of every axis once, the other axes at their first.
    ///
    /// # Errors
    /// An index that there is not, or that runs of a sweep are too short for; a value or case that is refused, with
    /// file and line; too many cases.
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
        let wrong = |line: u64, message: String| StudyFileError::Line {
            name: parameters.file.clone(),
            line,
            message,
        };
        let mut observed = Vec::new();
        for name in &parameters.observed {
            let found = Observed::called(name);
            let known = super::OBSERVED.iter().map(|index| index.name);
            observed.push(*found.ok_or_else(|| {
                let hint = did_you_mean(name, known.clone());
                let known = known.clone().collect::<Vec<_>>().join(", ");
                wrong(
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
            let of_ride = observed.iter().find(|index| index.is_of_ride());
            check(&parameters, sweep, of_ride, &mut digest)?;
            let end = starts[starts.len() - 1].saturating_add(sweep.cases());
            if end > MOST_CASES {
                let message = format!("more than {MOST_CASES} cases up to sweep {}", sweep.name);
                return Err(wrong(sweep.line, message));
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

    /// How many cases there are.
    pub fn cases(&self) -> u64 {
        self.starts[self.starts.len() - 1]
    }

    /// Whether the files that the study names are as they were when it was read.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn is_unchanged(&self) -> Result<bool, StudyFileError> {
        Ok(Self::new(self.parameters.clone())?.digest == self.digest)
    }

    /// Of what the cases are; rows of studies with the same digest and version belong together.
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The case of a number; none beyond the last.
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

    /// Numbers of the cases of a sweep at a point, a case a seed.
    pub fn numbers(&self, sweep: &Sweep, point: u64) -> std::ops::Range<u64> {
        let sweeps = &self.parameters.sweeps;
        let at = sweeps.iter().position(|other| other.name == sweep.name);
        let seeds = sweep.seeds.len().max(1) as u64;
        let start = at.map_or(0, |at| self.starts[at]) + point * seeds;
        start..start + seeds
    }

    /// Numbers of the cases of a shard; all where there is none.
    pub fn part(&self, shard: Option<Shard>) -> impl Iterator<Item = u64> + use<> {
        let Shard { number, of } = shard.unwrap_or(Shard { number: 0, of: 1 });
        (number..self.cases()).step_by(usize::try_from(of).unwrap_or(usize::MAX))
    }

    /// The case of one of its cases.
    ///
    /// # Errors
    /// As [`Self::case_at`].
    pub fn build(&self, case: &StudyCase<'_>) -> Result<Case, StudyFileError> {
        self.case_at(case.sweep, &case.values(), case.seed)
    }

    /// The case of a sweep with a value of each axis, and a seed.
    ///
    /// # Errors
    /// A value or a case that is refused, with file and line.
    pub fn case_at(
        &self,
        sweep: &Sweep,
        values: &[&Value],
        seed: Option<u64>,
    ) -> Result<Case, StudyFileError> {
        let file = &self.parameters.file;
        let case = build(file, sweep, values)?;
        match seed {
            Some(seed) => seeded(file, sweep, case, seed),
            None => Ok(case),
        }
    }
}

impl Shard {
    /// Whether it has a case.
    pub fn has(self, case: u64) -> bool {
        case % self.of == self.number
    }
}

impl StudyCase<'_> {
    /// The value of each axis of its sweep.
    pub fn values(&self) -> Vec<&Value> {
        self.sweep.values(self.point)
    }
}

/// The case with another seed.
fn seeded(file: &str, sweep: &Sweep, case: Case, seed: u64) -> Result<Case, StudyFileError> {
    match case.track.with_seed(seed) {
        Some(track) => Ok(Case { track, ..case }),
        None => Err(StudyFileError::Line {
            name: file.to_owned(),
            line: sweep.line,
            message: format!(
                "sweep {}: seeds, but the track {} has no irregularity of a spectrum",
                sweep.name, case.track.name
            ),
        }),
    }
}

fn build(file: &str, sweep: &Sweep, values: &[&Value]) -> Result<Case, StudyFileError> {
    let at = || {
        let named = sweep.axes.iter().zip(values);
        let named = named.map(|(axis, value)| format!("{} {value}", axis.parameter));
        match named.collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => none,
            some => format!(" at {some}"),
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
            at: at(),
            source: Box::new(source),
        })
}

/// Builds the cases that together have every value, and adds them to the digest.
fn check(
    study: &StudyParameters,
    sweep: &Sweep,
    of_ride: Option<&Observed>,
    digest: &mut Digest,
) -> Result<(), StudyFileError> {
    digest.add(&sweep.name);
    digest.add(&sweep.seeds);
    let first = sweep.values(0);
    let mut add = |values: &[&Value]| -> Result<(), StudyFileError> {
        let case = build(&study.file, sweep, values)?;
        let case = match sweep.seeds.first() {
            Some(seed) => seeded(&study.file, sweep, case, *seed)?,
            None => case,
        };
        if let (Some(index), Err(reason)) = (of_ride, check_ride(&case)) {
            return Err(StudyFileError::Line {
                name: study.file.clone(),
                line: sweep.line,
                message: format!(
                    "sweep {}: observed `{}`: {reason}; allowed: a longer duration_s, or this index left out of \
                     `observed`",
                    sweep.name, index.name
                ),
            });
        }
        digest.add_case(&case)?;
        Ok(())
    };
    add(&first)?;
    for (number, axis) in sweep.axes.iter().enumerate() {
        for value in &axis.values[1..] {
            let mut values = first.clone();
            values[number] = value;
            add(&values)?;
        }
    }
    for axis in &sweep.axes {
        let values: Vec<String> = axis.values.iter().map(ToString::to_string).collect();
        digest.add(&(&axis.parameter, values, &axis.set));
    }
    Ok(())
}
