//! The cases of a study, run.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use super::observed::Observed;
use super::row::Row;
use super::shared::Shared;
use super::study::Study;
use crate::files::case::Case;
use crate::files::study::StudyFileError;
use crate::study::vehicle::{Ending, Indexer, Indices, VehicleStudyError};

/// Last time of a run in which a limit cycle's amplitude is taken, s.
const LAST_S: f64 = 3.0;

/// Ticks between two looks whether the run is still wanted.
const TICKS_A_LOOK: u64 = 1024;

/// What indices are taken of.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Indices of the run.
    pub indices: Indices,
    /// Greatest lateral displacement of a wheelset in the last 3 s, m.
    pub last_lateral_m: f64,
}

/// Runs a case to its end, looking at every state.
///
/// # Errors
/// As [`Shared::run`].
pub fn observe(
    case: &Case,
    shared: &Shared,
    is_unwanted: &dyn Fn() -> bool,
    mut look: impl FnMut(&crate::study::vehicle::Run),
) -> Result<(Ending, Option<Observation>), VehicleStudyError> {
    let mut run = shared.run(case)?;
    let mut indexer = Indexer::new(case);
    let last = run.ticks().saturating_sub((LAST_S / case.step_s) as u64);
    let wheelsets = run.vehicle().names().len() - run.vehicle().wheelsets();
    let mut last_lateral_m = 0.0_f64;
    let ending = loop {
        if let Some(ending) = run.step()? {
            break ending;
        }
        indexer.add(run.state());
        look(&run);
        if run.state().ticks() > last {
            let lateral = run.state().coordinates()[wheelsets..].iter();
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
    });
    Ok((ending, observation))
}

/// Why a study does not go on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A case is refused.
    #[error(transparent)]
    Case(#[from] StudyFileError),
    /// A case cannot be run.
    #[error("case {number} of sweep {sweep}: {source}")]
    Run {
        /// Number of the case.
        number: u64,
        /// Its sweep.
        sweep: String,
        /// What is wrong with it.
        source: VehicleStudyError,
    },
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
    mut take: impl FnMut(Row) -> Result<(), E>,
) -> Result<(), E> {
    let shared = Shared::default();
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let is_unwanted = || stopped.load(Ordering::Relaxed) || is_unwanted();
    let (send, rows) = mpsc::channel::<Result<Row, RunError>>();
    thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            let send = send.clone();
            let (shared, next, is_unwanted) = (&shared, &next, &is_unwanted);
            scope.spawn(move || {
                while !is_unwanted() {
                    let Some(number) = numbers.get(next.fetch_add(1, Ordering::Relaxed)) else {
                        return;
                    };
                    let row = one(study, *number, shared, is_unwanted);
                    let row = row.transpose().map(|row| send.send(row));
                    if let Some(Err(_)) = row {
                        return;
                    }
                }
            });
        }
        drop(send);
        let mut done = Ok(());
        for row in rows {
            // Rows that come after a failure are of cases that had begun.
            if done.is_ok() {
                done = row.map_err(E::from).and_then(&mut take);
                stopped.store(done.is_err(), Ordering::Relaxed);
            }
        }
        done
    })
}

/// The row of a case; none where it was interrupted.
fn one(
    study: &Study,
    number: u64,
    shared: &Shared,
    is_unwanted: &dyn Fn() -> bool,
) -> Result<Option<Row>, RunError> {
    let Some(of_study) = study.case(number) else {
        return Ok(None);
    };
    let case = of_study.build(&study.parameters.file)?;
    let (ending, observation) =
        observe(&case, shared, is_unwanted, |_| ()).map_err(|source| RunError::Run {
            number,
            sweep: of_study.sweep.name.clone(),
            source,
        })?;
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
        observed: study.observed.iter().map(value).collect(),
    }))
}
