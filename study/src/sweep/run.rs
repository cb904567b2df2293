//! Runs the cases of a study.

use super::observation::Observation;
use super::observed::Observed;
use super::row::Row;
use super::shared::Shared;
use super::study::Study;
use dashpot_files::case::Case;
use dashpot_files::study::{StudyFileError, Sweep};
use dashpot_vehicle_run::wear::WearLaw;
use dashpot_vehicle_run::{Ending, Indexer, RunWear, ValidityWatch, VehicleRunError, confirmed};

/// Length of the last part of a run, in which the amplitude of a limit cycle is measured, s.
const LAST_S: f64 = 3.0;

/// Ticks between checks for cancellation.
const TICKS_PER_CHECK: u64 = 1024;

/// Runs a case to its end, or until `is_cancelled` returns true, and observes what the indices `observed` need. The
/// observation is `None` if the run did not complete.
///
/// # Errors
/// Same errors as [`Shared::run`].
pub fn observe(
    case: &Case,
    shared: &Shared,
    observed: &[Observed],
    is_cancelled: &dyn Fn() -> bool,
) -> Result<(Ending, Option<Observation>), VehicleRunError> {
    let mut run = shared.run(case)?;
    let needs_wear = observed.iter().any(Observed::needs_wear);
    let mut wear = needs_wear.then(|| RunWear::new(case, &run, WearLaw::default()));
    let mut indexer = Indexer::new(case);
    let mut watch = ValidityWatch::new(case, run.track());
    let last = run.ticks().saturating_sub((LAST_S / case.step_s) as u64);
    let bodies = run.vehicle().names().len() - run.vehicle().wheelsets();
    let mut last_lateral_m = 0.0_f64;
    let ending = loop {
        if let Some(ending) = run.step()? {
            break ending;
        }
        indexer.add(run.state());
        watch.add(run.state());
        if let Some(wear) = &mut wear {
            wear.add(run.state());
        }
        if run.state().ticks() > last {
            let lateral = run.state().coordinates()[bodies..].iter();
            last_lateral_m = lateral.fold(last_lateral_m, |max, q| max.max(q[0].abs()));
        }
        if run.state().ticks() % TICKS_PER_CHECK == 0 && is_cancelled() {
            break run.interrupted();
        }
    };
    let ending = confirmed(case, &run, ending)?;
    let indices = (ending == Ending::Completed).then(|| indexer.indices());
    let observation = indices.flatten().map(|indices| Observation {
        indices,
        last_lateral_m,
        max_wear_depth_um_per_1000km: wear
            .and_then(|wear| Some(wear.indices()?.worst()?.max_depth_um_per_1000km)),
        wheel_load_over_static: watch.greatest_load_ratio(),
        wheel_lift_longest_s: watch.longest_lift_s(),
    });
    Ok((ending, observation))
}

/// Error that stops a study.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Invalid case.
    #[error("{0}")]
    Case(Box<StudyFileError>),
    /// A case cannot be run.
    #[error("sweep {sweep}: {source}")]
    Run {
        /// Name of the sweep.
        sweep: String,
        /// Reason.
        source: Box<VehicleRunError>,
    },
    /// A figure cannot be drawn.
    #[error("figure of sweep {sweep}: {reason}")]
    Figure {
        /// Name of the sweep.
        sweep: String,
        /// Reason.
        reason: String,
    },
}

impl From<StudyFileError> for RunError {
    fn from(error: StudyFileError) -> Self {
        Self::Case(Box::new(error))
    }
}

impl RunError {
    /// Adds the sweep to the error of a run.
    pub fn in_sweep(sweep: &Sweep, source: VehicleRunError) -> Self {
        Self::Run {
            sweep: sweep.name.clone(),
            source: Box::new(source),
        }
    }
}

/// Runs the cases with these numbers on a pool of `threads` threads, and passes each row to `on_row` as soon as it is
/// complete. Cases interrupted by `is_cancelled` have no row.
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
    run_with(
        study,
        &Shared::default(),
        numbers,
        threads,
        is_cancelled,
        on_row,
    )
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
    let work = |number: &u64, is_ended: &dyn Fn() -> bool| {
        let is_cancelled = || is_ended() || is_cancelled();
        if is_cancelled() {
            return Ok(None);
        }
        row(study, *number, shared, &is_cancelled)
    };
    dashpot_workers::in_parallel(numbers, threads, work, |_, row| match row? {
        Some(row) => on_row(row),
        None => Ok(()),
    })
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
    let Some(study_case) = study.case(number) else {
        return Ok(None);
    };
    let case = study.build(&study_case)?;
    let (ending, observation) = observe(&case, shared, &study.observed, is_cancelled)
        .map_err(|source| RunError::in_sweep(study_case.sweep, source))?;
    if matches!(ending, Ending::Interrupted { .. }) {
        return Ok(None);
    }
    let value = |index: &Observed| {
        let value = (index.extract)(observation.as_ref()?)?;
        value.is_finite().then_some(value)
    };
    Ok(Some(Row {
        case: number,
        ending: ending.to_string(),
        observed: study.observed.iter().map(value).collect(),
    }))
}
