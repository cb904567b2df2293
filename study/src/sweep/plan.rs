//! Runs the cases of a study: identical ones once, the longest first.

use std::collections::HashMap;

use super::curves::{CurveKey, Curves, Needed};
use super::digest::Digest;
use super::observed::IndexValues;
use super::row::Row;
use super::run::{RunError, Simulated, simulate};
use super::shared::Shared;
use super::study::{Study, StudyCase};

/// Cases to run, with identical ones together.
#[derive(Debug)]
pub struct Plan<'a> {
    study: &'a Study,
    threads: usize,
    /// In the order in which they start.
    groups: Vec<Group>,
}

/// Results of a case.
#[derive(Debug, Clone)]
pub struct Computed {
    /// Row of the case.
    pub row: Row,
    /// Curves that were needed.
    pub curves: Curves,
    /// All indices that the run has; the row has those that the study observes.
    pub indices: IndexValues,
}

/// Cases with the same vehicle, track, parameters and seed, which therefore have the same result.
#[derive(Debug)]
struct Group {
    numbers: Vec<u64>,
    /// Relative duration of the simulation.
    work: f64,
}

impl<'a> Plan<'a> {
    /// Plans the cases with these numbers on a pool of `threads` threads.
    ///
    /// # Errors
    /// Invalid case.
    ///
    /// ```
    /// use dashpot_files::study::StudyParameters;
    /// use dashpot_study::sweep::{Plan, Study};
    /// let study = Study::new(StudyParameters::load("paper")?)?;
    /// let numbers: Vec<u64> = study.part(None).collect();
    /// // Each sweep contains the nominal dampers.
    /// assert_eq!(Plan::new(&study, &numbers, 2)?.simulations(), 456);
    /// assert_eq!(numbers.len(), 536);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn new(study: &'a Study, numbers: &[u64], threads: usize) -> Result<Self, RunError> {
        let cases: Vec<StudyCase<'_>> = numbers
            .iter()
            .filter_map(|case| study.case(*case))
            .collect();
        let mut points = cases.clone();
        points.dedup_by(|a, b| point_of(a) == point_of(b));
        let built = dashpot_workers::map(&points, |case| -> Result<_, RunError> {
            let case = study.case_at(case.sweep, &case.values(), None)?;
            let mut digest = Digest::default();
            digest.add_case(&case)?;
            let work = case.duration_s / case.step_s * case.vehicle.wheelsets.len() as f64;
            Ok((digest.bytes(), work))
        })?;
        let mut groups: Vec<Group> = Vec::new();
        let mut known = HashMap::new();
        let mut at = 0;
        for case in cases {
            while point_of(&points[at]) != point_of(&case) {
                at += 1;
            }
            let (digest, work) = built[at];
            let group = *known.entry((digest, case.seed)).or_insert_with(|| {
                let numbers = Vec::new();
                groups.push(Group { numbers, work });
                groups.len() - 1
            });
            groups[group].numbers.push(case.number);
        }
        // A long run that starts last would leave the other threads without work.
        groups.sort_by(|a, b| b.work.total_cmp(&a.work));
        Ok(Self {
            study,
            threads,
            groups,
        })
    }

    /// Number of simulations, which identical cases share.
    pub fn simulations(&self) -> usize {
        self.groups.len()
    }

    /// The study.
    pub(super) fn study(&self) -> &Study {
        self.study
    }

    /// Number of threads.
    pub(super) fn threads(&self) -> usize {
        self.threads
    }

    /// Relative duration of all simulations.
    pub(super) fn work(&self) -> f64 {
        self.groups.iter().map(|group| group.work).sum()
    }

    /// Number and relative duration of the case that takes longest.
    pub(super) fn longest(&self) -> Option<(u64, f64)> {
        let group = self.groups.first()?;
        Some((*group.numbers.first()?, group.work))
    }

    /// Runs the cases, and passes the results of each, with the curves of it that are `needed`, as soon as it is
    /// complete.
    /// Cases interrupted by `is_cancelled` have no row.
    ///
    /// A row depends only on its case; the order of the cases and the number of threads do not change it.
    ///
    /// # Errors
    /// Returns an error for an invalid case, or the error of `on_result`. After an error, no further case starts.
    pub fn run<E: From<RunError>>(
        &self,
        shared: &Shared,
        needed: &Needed,
        is_cancelled: &(dyn Fn() -> bool + Sync),
        mut on_result: impl FnMut(Computed) -> Result<(), E>,
    ) -> Result<(), E> {
        let work = |group: &Group, is_ended: &dyn Fn() -> bool| {
            let is_cancelled = || is_ended() || is_cancelled();
            if is_cancelled() {
                return Ok(Vec::new());
            }
            run_group(self.study, &group.numbers, shared, needed, &is_cancelled)
        };
        dashpot_workers::in_parallel(&self.groups, self.threads, work, |_, results| {
            results?.into_iter().try_for_each(&mut on_result)
        })
    }
}

/// Sweep and combination of values of a case.
fn point_of<'a>(case: &StudyCase<'a>) -> (&'a str, u64) {
    (&case.sweep.name, case.point)
}

/// Runs the cases with these numbers on a pool of `threads` threads, and passes each row to `on_row` as soon as it is
/// complete. Identical cases are simulated once. Cases interrupted by `is_cancelled` have no row.
///
/// A row depends only on its case; the order of the cases and the number of threads do not change it.
///
/// # Errors
/// Returns an error for an invalid case, or the error of `on_row`. After an error, no further case starts.
pub fn run<E: From<RunError>>(
    study: &Study,
    numbers: &[u64],
    threads: usize,
    is_cancelled: &(dyn Fn() -> bool + Sync),
    on_row: impl FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let shared = Shared::default();
    run_with(study, &shared, numbers, threads, is_cancelled, on_row)
}

/// Same as [`run`], but reuses contacts and tracks from `shared`.
///
/// # Errors
/// Same errors as [`run`].
pub fn run_with<E: From<RunError>>(
    study: &Study,
    shared: &Shared,
    numbers: &[u64],
    threads: usize,
    is_cancelled: &(dyn Fn() -> bool + Sync),
    mut on_row: impl FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let plan = Plan::new(study, numbers, threads)?;
    let take = |computed: Computed| on_row(computed.row);
    plan.run(shared, &Needed::new(), is_cancelled, take)
}

/// Runs a case and returns its row. Returns `None` if there is no case with this number, or if the run was cancelled.
///
/// # Errors
/// Invalid case.
pub fn row(
    study: &Study,
    number: u64,
    shared: &Shared,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<Option<Row>, RunError> {
    let results = run_group(study, &[number], shared, &Needed::new(), is_cancelled)?;
    Ok(results.into_iter().next().map(|computed| computed.row))
}

/// Simulates identical cases once; returns the results of each, or nothing if the run was cancelled.
fn run_group(
    study: &Study,
    numbers: &[u64],
    shared: &Shared,
    needed: &Needed,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<Vec<Computed>, RunError> {
    let Some(first) = numbers.first().and_then(|number| study.case(*number)) else {
        return Ok(Vec::new());
    };
    let case = study.build(&first)?;
    let of_case = |number: &u64| needed.get(number).into_iter().flatten();
    let signals = numbers.iter().flat_map(of_case);
    let signals = signals.map(|(signal, _)| signal.as_str());
    let simulated = simulate(&case, shared, &study.observed, signals, is_cancelled);
    let simulated = simulated.map_err(|source| RunError::in_sweep(first.sweep, source))?;
    let Some(Simulated {
        ending,
        observed,
        indices,
        recorder,
    }) = simulated
    else {
        return Ok(Vec::new());
    };
    let with_number = |number: &u64| {
        let row = Row {
            case: *number,
            ending: ending.clone(),
            observed: observed.clone(),
        };
        let curves = of_case(number).filter_map(|(signal, kind)| {
            let key = CurveKey {
                case: *number,
                signal: signal.clone(),
                kind: *kind,
            };
            Some((key, recorder.curve(signal, *kind)?))
        });
        Computed {
            row,
            curves: curves.collect(),
            indices: indices.clone(),
        }
    };
    Ok(numbers.iter().map(with_number).collect())
}
