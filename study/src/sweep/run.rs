//! Runs a case and observes its indices.

use super::curves::Recorder;
use super::observation::Observation;
use super::observed::{IndexValues, OBSERVED, Observed};
use super::shared::Shared;
use dashpot_files::case::Case;
use dashpot_files::study::{StudyFileError, Sweep};
use dashpot_vehicle_run::wear::WearLaw;
use dashpot_vehicle_run::{
    Ending, Indexer, Run, RunWear, ValidityWatch, VehicleRunError, confirmed,
};

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
    let mut recorder = Recorder::new(&run, std::iter::empty());
    observe_run(case, &mut run, observed, &mut recorder, is_cancelled)
}

/// Results of a run that was not cancelled.
pub(super) struct Simulated {
    /// Ending, as text.
    pub ending: String,
    /// Observed indices, in the order of a row.
    pub observed: Vec<Option<f64>>,
    /// All indices that the run has.
    pub indices: IndexValues,
    /// Histories of the recorded signals.
    pub recorder: Recorder,
}

/// Runs a case, observes its indices and records the signals with these names. Returns `None` if it was cancelled.
///
/// # Errors
/// Same errors as [`Shared::run`].
pub(super) fn simulate<'a>(
    case: &Case,
    shared: &Shared,
    observed: &[Observed],
    signals: impl Iterator<Item = &'a str>,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<Option<Simulated>, VehicleRunError> {
    let mut run = shared.run(case)?;
    let mut recorder = Recorder::new(&run, signals);
    let (ending, observation) = observe_run(case, &mut run, observed, &mut recorder, is_cancelled)?;
    if matches!(ending, Ending::Interrupted { .. }) {
        return Ok(None);
    }
    let value = |index: &Observed| {
        let value = (index.extract)(observation.as_ref()?)?;
        value.is_finite().then_some(value)
    };
    let has_wear = observed.iter().any(Observed::needs_wear);
    let known = OBSERVED
        .iter()
        .filter(|index| has_wear || !index.needs_wear());
    Ok(Some(Simulated {
        indices: known
            .map(|index| (index.name.to_owned(), value(index)))
            .collect(),
        ending: ending.to_string(),
        observed: observed.iter().map(value).collect(),
        recorder,
    }))
}

/// Steps a run to its end, or until `is_cancelled` returns true, and observes it.
///
/// # Errors
/// The model fails.
pub(super) fn observe_run(
    case: &Case,
    run: &mut Run,
    observed: &[Observed],
    recorder: &mut Recorder,
    is_cancelled: &dyn Fn() -> bool,
) -> Result<(Ending, Option<Observation>), VehicleRunError> {
    let needs_wear = observed.iter().any(Observed::needs_wear);
    let mut wear = needs_wear.then(|| RunWear::new(case, run, WearLaw::default()));
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
        recorder.add(run.state(), run.time_s());
        if let Some(wear) = &mut wear {
            wear.add(run.state());
        }
        if run.state().ticks() > last {
            let lateral = run.state().coordinates()[bodies..].iter();
            last_lateral_m = lateral.fold(last_lateral_m, |max, q| max.max(q[0].abs()));
        }
        if run.state().ticks().is_multiple_of(TICKS_PER_CHECK) && is_cancelled() {
            break run.interrupted();
        }
    };
    let ending = confirmed(case, run, ending)?;
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
