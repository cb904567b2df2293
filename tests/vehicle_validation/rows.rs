//! Kept rows of a study, and changes of indices between parameter values.

use dashpot::document;
use dashpot_files::study::{StudyParameters, Sweep, Value};
use dashpot_study::sweep::rows::{self, Rows, RowsError};
use dashpot_study::sweep::{Estimate, Study};
use xtask::vehicle_validation::SEEDS;

/// A study with its kept rows.
pub struct Kept {
    pub study: Study,
    pub rows: Rows,
}

impl Kept {
    /// Loads a shipped study with its rows in `data/studies/rows/`.
    pub fn load(name: &str) -> Self {
        Self::read(name).unwrap_or_else(|error| {
            panic!("{error}\nthe rows are written by `cargo xtask vehicle-validation`")
        })
    }

    /// Loads a shipped study with its rows.
    ///
    /// # Errors
    /// Invalid rows.
    pub fn read(name: &str) -> Result<Self, RowsError> {
        let parameters = StudyParameters::load(name).expect("a shipped study");
        let study = Study::new(parameters.with_seeds(SEEDS)).expect("a shipped study");
        let path = document::in_repository(&format!("data/studies/rows/{name}.csv"));
        let rows = rows::read_once(&study, path.as_ref())?;
        assert_eq!(rows.len() as u64, study.cases(), "every case of {name}");
        Ok(Self { study, rows })
    }

    pub fn sweep(&self, name: &str) -> &Sweep {
        let sweep = self.study.parameters.sweep(name);
        sweep.unwrap_or_else(|| panic!("no sweep `{name}`"))
    }

    /// Point of a sweep at a value of its last axis; `first` is the value of the first axis if there are two.
    pub fn point(&self, sweep: &Sweep, first: Option<&str>, last: f64) -> u64 {
        let is_at = |point: &u64| {
            let values = sweep.values(*point);
            let at_last = values.last().is_some_and(|value| match value {
                Value::Number(number) => (number - last).abs() <= 1e-9 * last.abs(),
                Value::Word(_) => false,
            });
            at_last && first.is_none_or(|first| values[0].to_string() == first)
        };
        let found = (0..sweep.points()).find(is_at);
        found.unwrap_or_else(|| panic!("sweep {}: no value {last}", sweep.name))
    }

    /// Values of an index at a point, one per seed; `None` if the run ended early.
    pub fn values(&self, sweep: &Sweep, point: u64, index: &str) -> Vec<Option<f64>> {
        let observed = &self.study.observed;
        let number = observed.iter().position(|observed| observed.name == index);
        let number = number.unwrap_or_else(|| panic!("{index} is not observed"));
        let numbers = self.study.numbers(sweep, point);
        numbers
            .map(|case| self.rows[&case].observed[number])
            .collect()
    }

    pub fn mean(&self, sweep: &Sweep, point: u64, index: &str) -> Estimate {
        let values: Vec<f64> = self
            .values(sweep, point, index)
            .into_iter()
            .flatten()
            .collect();
        Estimate::of(&values).expect("seeds")
    }

    /// Relative change of an index between two points in percent: the mean over the seeds whose runs reached their
    /// ends. Both points have the same irregularities.
    pub fn change(&self, sweep: &Sweep, points: [u64; 2], index: &str) -> Estimate {
        let [from, to] = points.map(|point| self.values(sweep, point, index));
        Estimate::of_change(&from, &to).expect("seeds")
    }

    /// Range of the means of an index along a sweep, relative to their mean, in percent.
    pub fn range(&self, sweep: &Sweep, index: &str) -> f64 {
        let means: Vec<f64> = (0..sweep.points())
            .map(|point| self.mean(sweep, point, index).mean)
            .collect();
        let greatest = means.iter().copied().fold(f64::MIN, f64::max);
        let least = means.iter().copied().fold(f64::MAX, f64::min);
        100.0 * (greatest - least) * means.len() as f64 / means.iter().sum::<f64>()
    }
}

/// A sentence about the runs that ended early, with their reasons.
pub fn early_endings(studies: &[&Kept]) -> String {
    let rows = studies.iter().flat_map(|kept| kept.rows.values());
    let early: Vec<&str> = rows
        .clone()
        .map(|row| &*row.ending)
        .filter(|ending| *ending != "completed")
        .collect();
    if early.is_empty() {
        return "Every run reached its end.".into();
    }
    let mut reasons: Vec<(&str, usize)> = Vec::new();
    for ending in &early {
        let reason = ending.split(" at ").next().unwrap_or_default();
        match reasons.iter_mut().find(|(known, _)| *known == reason) {
            Some((_, count)) => *count += 1,
            None => reasons.push((reason, 1)),
        }
    }
    let reasons: Vec<String> = reasons
        .iter()
        .map(|(reason, count)| format!("{count} {reason}"))
        .collect();
    format!(
        "{} of {} runs ended early ({}), and means and changes leave out their seeds.",
        early.len(),
        rows.count(),
        reasons.join("; ")
    )
}

/// Formats a change in percent with its confidence interval.
pub fn percent(change: &Estimate) -> String {
    match change.confidence {
        Some(half) => format!("{:+.2} ± {half:.2}", change.mean),
        None => format!("{:+.2}", change.mean),
    }
}

/// Ends of the confidence interval of a change.
pub fn interval(change: &Estimate) -> [f64; 2] {
    let half = change.confidence.unwrap_or(0.0);
    [change.mean - half, change.mean + half]
}
