//! Tables of a study file.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use toml::Spanned;

use super::axis::Axis;
use super::figure::{Figure, FigureTable};
use super::vary::VaryTable;
use super::{StudyFileError, StudyParameters, Sweep};
use crate::case::{CaseError, CaseNumbers, CaseParts};
use crate::contact::ContactOptions;
use crate::lines::line_at;
use crate::overrides::did_you_mean;
use crate::shipped::{Found, resolve_name};
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
    contact: Option<ContactOptions>,
    #[serde(default)]
    dampers: BTreeMap<String, String>,
    #[serde(default)]
    set: Vec<String>,
    seeds: Option<Vec<u64>>,
    #[serde(default)]
    vary: Vec<Spanned<VaryTable>>,
}

impl StudyTables {
    /// Converts the tables to a study.
    pub fn parameters(self, found: &Found) -> Result<StudyParameters, StudyFileError> {
        let error_at = |start: usize, message: String| StudyFileError::Line {
            name: found.name.clone(),
            line: line_at(&found.text, start),
            message,
        };
        let observed_at = self.observed.span().start;
        let observed = self.observed.into_inner();
        let once: BTreeSet<&String> = observed.iter().collect();
        if observed.is_empty() || once.len() < observed.len() {
            let message =
                "observed: empty or with a duplicate, allowed: one or more indices, each once";
            return Err(error_at(observed_at, message.into()));
        }
        if self.sweep.is_empty() {
            return Err(error_at(0, "no sweeps, allowed: one or more".into()));
        }
        let mut sweeps = Vec::new();
        let mut names = BTreeSet::new();
        for table in self.sweep {
            let start = table.span().start;
            let table = table.into_inner();
            if table.name.is_empty() || table.name.contains(char::is_control) {
                let message = "empty or multi-line name of a sweep, allowed: one line of text";
                return Err(error_at(start, message.into()));
            }
            if !names.insert(table.name.clone()) {
                return Err(error_at(
                    start,
                    format!("duplicate sweep name `{}`", table.name),
                ));
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
            let figure = figure.map_err(|message| error_at(start, message))?;
            study.figures.push(figure);
        }
        Ok(study)
    }
}

impl StudyParameters {
    /// Checks that the study has the sweeps, values and indices that the figure shows.
    fn check(&self, figure: Figure) -> Result<Figure, String> {
        if figure.content.sweeps().is_empty() {
            return Err("no sweeps, allowed: one or more".into());
        }
        let names = || self.sweeps.iter().map(|sweep| sweep.name.as_str());
        for wanted in figure.content.sweeps() {
            if self.sweep(wanted).is_none() {
                return Err(format!(
                    "no sweep `{wanted}`{}",
                    did_you_mean(wanted, names())
                ));
            }
        }
        for (sweep, value) in figure.content.values() {
            let axis = self.sweep(sweep).and_then(|sweep| sweep.axes.first());
            if !axis.is_some_and(|axis| axis.values.contains(value)) {
                return Err(format!(
                    "{value} is not a value of the first axis of sweep {sweep}"
                ));
            }
        }
        if let super::FigureContent::Indices {
            observed, sweeps, ..
        } = &figure.content
        {
            let has_two_axes =
                |name: &String| self.sweep(name).is_some_and(|sweep| sweep.axes.len() > 1);
            if observed.len() > 1 && sweeps.iter().any(has_two_axes) {
                return Err("several indices of a sweep with two axes, allowed: one index".into());
            }
            if observed.is_empty() {
                return Err("no observed indices, allowed: one or more".into());
            }
            let names = || self.observed.iter().map(String::as_str);
            if let Some(wanted) = observed
                .iter()
                .find(|wanted| !self.observed.contains(wanted))
            {
                return Err(format!(
                    "`{wanted}` is not in `observed`{}",
                    did_you_mean(wanted, names())
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
        let invalid = |line: u64, message: String| StudyFileError::Line {
            name: name.clone(),
            line,
            message,
        };
        let resolve = |name: &String| resolve_name(folder, name);
        let [base_case, vehicle, track] =
            [&self.case, &self.vehicle, &self.track].map(|name| name.as_ref().map(resolve));
        let parts = CaseParts {
            case: base_case.as_deref(),
            vehicle: vehicle.as_deref(),
            track: track.as_deref(),
            numbers: CaseNumbers {
                speed_km_h: self.speed_km_h,
                duration_s: self.duration_s,
                start_m: self.start_m,
                friction: self.friction,
                normal_damping_s_per_m: self.normal_damping_s_per_m,
                step_us: self.step_us,
                push_m: self.push_m,
            },
        };
        let options = parts.options();
        let Some(mut case) = options.map_err(|source| self.case_error(name, line, source))? else {
            let sweep = &self.name;
            let message = format!("sweep {sweep}: give `case`, or `track` and `speed_km_h`");
            return Err(invalid(line, message));
        };
        let replacements = self
            .dampers
            .iter()
            .map(|(dampers, damper)| Replacement::named(dampers.clone(), resolve(damper)));
        case.dampers.extend(replacements);
        if let Some(mut contact) = self.contact {
            contact.resolve_files(folder);
            case.replace_contact(contact);
        }
        case.overrides.extend(self.set);
        let mut axes: Vec<Axis> = Vec::new();
        for vary in self.vary {
            let at = line_at(text, vary.span().start);
            let axis = vary.into_inner().axis(folder);
            let axis = axis.map_err(|error| invalid(at, error))?;
            if axes.iter().any(|other| other.parameter == axis.parameter) {
                return Err(invalid(
                    at,
                    format!("vary: duplicate parameter {}", axis.parameter),
                ));
            }
            axes.push(axis);
        }
        let seeds = self.seeds.unwrap_or_else(|| seeds.to_vec());
        let once: BTreeSet<u64> = seeds.iter().copied().collect();
        if once.len() < seeds.len() {
            return Err(invalid(
                line,
                format!("sweep {}: duplicate seed", self.name),
            ));
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

    fn case_error(&self, name: &str, line: u64, source: CaseError) -> StudyFileError {
        StudyFileError::Case {
            name: name.to_owned(),
            line,
            sweep: self.name.clone(),
            at: String::new(),
            source: Box::new(source),
        }
    }
}
