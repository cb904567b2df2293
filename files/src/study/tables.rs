//! The tables of a study file.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use toml::Spanned;

use super::axis::Axis;
use super::figure::{Figure, FigureTable};
use super::vary::VaryTable;
use super::{StudyFileError, StudyParameters, Sweep};
use crate::case::{CaseError, CaseParts};
use crate::lines::line_at;
use crate::overrides::nearest;
use crate::shipped::{Found, named_in};
use crate::vehicle::Replacement;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StudyTables {
    name: String,
    #[serde(default)]
    seeds: Vec<u64>,
    observed: Spanned<Vec<String>>,
    sweep: Vec<Spanned<SweepTable>>,
    #[serde(default)]
    figure: Vec<Spanned<FigureTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SweepTable {
    name: String,
    title: Option<String>,
    case: Option<String>,
    vehicle: Option<String>,
    track: Option<String>,
    speed_km_h: Option<f64>,
    duration_s: Option<f64>,
    start_m: Option<f64>,
    friction: Option<f64>,
    normal_damping_s_per_m: Option<f64>,
    step_us: Option<f64>,
    push_m: Option<f64>,
    #[serde(default)]
    dampers: BTreeMap<String, String>,
    #[serde(default)]
    set: Vec<String>,
    seeds: Option<Vec<u64>>,
    #[serde(default)]
    vary: Vec<Spanned<VaryTable>>,
}

impl StudyTables {
    /// The study in the file that was found.
    pub fn parameters(self, found: &Found) -> Result<StudyParameters, StudyFileError> {
        let wrong_at = |start: usize, message: String| StudyFileError::Line {
            name: found.name.clone(),
            line: line_at(&found.text, start),
            message,
        };
        let observed_at = self.observed.span().start;
        let observed = self.observed.into_inner();
        let once: BTreeSet<&String> = observed.iter().collect();
        if observed.is_empty() || once.len() < observed.len() {
            let message = "observed: allowed: one index or more, each once";
            return Err(wrong_at(observed_at, message.into()));
        }
        if self.sweep.is_empty() {
            return Err(wrong_at(0, "sweep: allowed: one or more".into()));
        }
        let mut sweeps = Vec::new();
        let mut names = BTreeSet::new();
        for table in self.sweep {
            let start = table.span().start;
            let table = table.into_inner();
            if table.name.is_empty() || table.name.contains(char::is_control) {
                let message = "name of a sweep: allowed: one line that is not empty";
                return Err(wrong_at(start, message.into()));
            }
            if !names.insert(table.name.clone()) {
                return Err(wrong_at(start, format!("a second sweep `{}`", table.name)));
            }
            sweeps.push(table.sweep(&self.seeds, start, found)?);
        }
        let mut study = StudyParameters {
            name: self.name,
            observed,
            observed_line: line_at(&found.text, observed_at),
            sweeps,
            figures: Vec::new(),
            file: found.name.clone(),
        };
        for table in self.figure {
            let start = table.span().start;
            let figure = table.into_inner().figure();
            let figure = figure.and_then(|figure| study.check(figure));
            let figure = figure.map_err(|message| wrong_at(start, message))?;
            study.figures.push(figure);
        }
        Ok(study)
    }
}

impl StudyParameters {
    /// The figure, if the study has what it draws.
    fn check(&self, figure: Figure) -> Result<Figure, String> {
        if figure.shown.sweeps().is_empty() {
            return Err("no sweeps, allowed: one or more".into());
        }
        let names = || self.sweeps.iter().map(|sweep| sweep.name.as_str());
        for wanted in figure.shown.sweeps() {
            if self.sweep(wanted).is_none() {
                return Err(format!("no sweep `{wanted}`{}", nearest(wanted, names())));
            }
        }
        for (sweep, value) in figure.shown.values() {
            let axis = self.sweep(sweep).and_then(|sweep| sweep.axes.first());
            if !axis.is_some_and(|axis| axis.values.contains(value)) {
                return Err(format!(
                    "{value} is no value of the first axis of sweep {sweep}"
                ));
            }
        }
        if let super::Shown::Indices {
            observed, sweeps, ..
        } = &figure.shown
        {
            let is_wide =
                |name: &String| self.sweep(name).is_some_and(|sweep| sweep.axes.len() > 1);
            if observed.len() > 1 && sweeps.iter().any(is_wide) {
                return Err("several indices over two axes, allowed: one".into());
            }
            if observed.is_empty() {
                return Err("no index observed, allowed: one or more".into());
            }
            let names = || self.observed.iter().map(String::as_str);
            if let Some(wanted) = observed
                .iter()
                .find(|wanted| !self.observed.contains(wanted))
            {
                return Err(format!(
                    "`{wanted}` is not among the observed{}",
                    nearest(wanted, names())
                ));
            }
        }
        Ok(figure)
    }
}

impl SweepTable {
    fn sweep(self, seeds: &[u64], start: usize, found: &Found) -> Result<Sweep, StudyFileError> {
        let Found { name, text, folder } = found;
        let line = line_at(text, start);
        let wrong = |line: u64, message: String| StudyFileError::Line {
            name: name.clone(),
            line,
            message,
        };
        let named = |name: &String| named_in(folder, name);
        let [of_case, vehicle, track] =
            [&self.case, &self.vehicle, &self.track].map(|name| name.as_ref().map(named));
        let parts = CaseParts {
            case: of_case.as_deref(),
            vehicle: vehicle.as_deref(),
            track: track.as_deref(),
            numbers: [
                self.speed_km_h,
                self.duration_s,
                self.start_m,
                self.friction,
                self.normal_damping_s_per_m,
                self.step_us,
                self.push_m,
            ],
        };
        let options = parts.options();
        let Some(mut case) = options.map_err(|source| self.refused(name, line, source))? else {
            let sweep = &self.name;
            let message = format!("sweep {sweep}: give `case`, or `track` and `speed_km_h`");
            return Err(wrong(line, message));
        };
        let replacements = self
            .dampers
            .iter()
            .map(|(dampers, by)| Replacement::named(dampers.clone(), named(by)));
        case.dampers.extend(replacements);
        case.overrides.extend(self.set);
        let mut axes: Vec<Axis> = Vec::new();
        for vary in self.vary {
            let at = line_at(text, vary.span().start);
            let axis = vary.into_inner().axis(folder);
            let axis = axis.map_err(|error| wrong(at, error))?;
            if axes.iter().any(|other| other.parameter == axis.parameter) {
                return Err(wrong(at, format!("vary: {} twice", axis.parameter)));
            }
            axes.push(axis);
        }
        let seeds = self.seeds.unwrap_or_else(|| seeds.to_vec());
        let once: BTreeSet<u64> = seeds.iter().copied().collect();
        if once.len() < seeds.len() {
            return Err(wrong(line, format!("sweep {}: a seed twice", self.name)));
        }
        Ok(Sweep {
            title: self.title.unwrap_or_else(|| self.name.clone()),
            name: self.name,
            case,
            axes,
            seeds,
            line,
        })
    }

    fn refused(&self, name: &str, line: u64, source: CaseError) -> StudyFileError {
        StudyFileError::Case {
            name: name.to_owned(),
            line,
            sweep: self.name.clone(),
            at: String::new(),
            source: Box::new(source),
        }
    }
}
