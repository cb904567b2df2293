//! The cases of a study, run.

use super::arithmetic::Arithmetic;
use super::observation::Observation;
use super::observed::Observed;
use super::row::Row;
use super::shared::Shared;
use super::study::Study;
use dashpot_files::case::Case;
use dashpot_files::study::{StudyFileError, Sweep};
use dashpot_vehicle_run::{Ending, Indexer, ValidityWatch, VehicleRunError};

/// Last time of a run in which a limit cycle's amplitude is taken, s.
const LAST_S: f64 = 3.0;

/// Ticks between two looks whether the run is still wanted.
const TICKS_A_LOOK: u64 = 1024;

/// Runs a case to its end, or until it is unwanted; no observation of a run that does not come to its end.
///
/// # Errors
/// As [`Shared::run`].
pub fn observe(
    case: &Case,
    shared: &Shared,
    is_unwanted: &dyn Fn() -> bool,
) -> Result<(Ending, Option<Observation>), VehicleRunError> {
    let mut run = shared.run(case)?;
    let mut indexer = Indexer::new(case);
    let mut watch = ValidityWatch::new(case);
    let last = run.ticks().saturating_sub((LAST_S / case.step_s) as u64);
    let bodies = run.vehicle().names().len() - run.vehicle().wheelsets();
    let mut last_lateral_m = 0.0_f64;
    let ending = loop {
        if let Some(ending) = run.step()? {
            break ending;
        }
        indexer.add(run.state());
        watch.add(run.state());
        if run.state().ticks() > last {
            let lateral = run.state().coordinates()[bodies..].iter();
            last_lateral_m = lateral.fold(last_lateral_m, |most, q| most.max(q[0].abs()));
        }
        if run.state().ticks() % TICKS_A_LOOK == 0 && is_unwanted() {
            break run.interrupted();
        }
    };
    let whole = (ending == Ending::Completed).then(|| indexer.indices());
    let observation = whole.flatten().map(|indices| Observation {
        indices,
        last_lateral_m,
        wheel_load_over_static: watch.greatest_load_ratio(),
        wheel_lift_longest_s: watch.longest_lift_s(),
    });
    Ok((ending, observation))
}

/// Why a study does not go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A case is refused.
    #[error("{0}")]
    Case(Box<StudyFileError>),
    /// A case cannot be run.
    #[error("sweep {sweep}: {source}")]
    Run {
        /// Its sweep.
        sweep: String,
        /// What is wrong with it.
        source: Box<VehicleRunError>,
    },
    /// A figure cannot be drawn.
    #[error("figure of sweep {sweep}: {reason}")]
    Figure {
        /// The sweep.
        sweep: String,
        /// What it lacks.
        reason: String,
    },
}

impl From<StudyFileError> for RunError {
    fn from(error: StudyFileError) -> Self {
        Self::Case(Box::new(error))
    }
}

impl RunError {
    /// A case of `sweep` cannot be run.
    pub fn of_sweep(sweep: &Sweep, source: VehicleRunError) -> Self {
        Self::Run {
            sweep: sweep.name.clone(),
            source: Box::new(source),
        }
    }
}

/// Runs the cases of these numbers on so many threads, and gives each row as soon as there is one; those of an interruption are left out.
///
/// A row is that of its case alone, so neither threads nor order change it.
///
/// # Errors
/// A case that is refused; what `take` returns. No other case is begun then.
pub fn run<E: From<RunError>>(
    study: &Study,
    numbers: &[u64],
    threads: usize,
    is_unwanted: &(dyn Fn() -> bool + Sync),
    take: impl FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    run_with(
        study,
        &Shared::default(),
        numbers,
        threads,
        is_unwanted,
        take,
    )
}

/// As [`run`], with what other runs have made.
///
/// # Errors
/// As [`run`].
pub fn run_with<E: From<RunError>>(
    study: &Study,
    shared: &Shared,
    numbers: &[u64],
    threads: usize,
    is_unwanted: &(dyn Fn() -> bool + Sync),
    mut take: impl FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let work = |number: &u64, is_ended: &dyn Fn() -> bool| {
        let is_unwanted = || is_ended() || is_unwanted();
        if is_unwanted() {
            return Ok(None);
        }
        row(study, *number, shared, &is_unwanted)
    };
    dashpot_workers::in_parallel(numbers, threads, work, |_, row| match row? {
        Some(row) => take(row),
        None => Ok(()),
    })
}

/// The row of a case; none of a number that no case has, or where it became unwanted.
///
/// # Errors
/// A case that is refused.
pub fn row(
    study: &Study,
    number: u64,
    shared: &Shared,
    is_unwanted: &dyn Fn() -> bool,
) -> Result<Option<Row>, RunError> {
    let Some(of_study) = study.case(number) else {
        return Ok(None);
    };
    let case = study.build(&of_study)?;
    let (ending, observation) = observe(&case, shared, is_unwanted)
        .map_err(|source| RunError::of_sweep(of_study.sweep, source))?;
    if matches!(ending, Ending::Interrupted { .. }) {
        return Ok(None);
    }
    let value = |index: &Observed| {
        let value = (index.of)(observation.as_ref()?)?;
        value.is_finite().then_some(value)
    };
    Ok(Some(Row {
        case: number,
        ending: ending.to_string(),
        arithmetic: Arithmetic::here(),
        observed: study.observed.iter().map(value).collect(),
    }))
}
