//! Signals of a case over time.

use super::RunError;
use super::shared::Shared;
use super::study::Study;
use dashpot_files::case::Case;
use dashpot_files::did_you_mean;
use dashpot_files::study::{Sweep, Value};
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::signals::{self, Signal};

/// Signals of a case, tick by tick.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Step, s.
    pub step_s: f64,
    /// Of each signal that was asked for.
    pub signals: Vec<Vec<f64>>,
}

impl Study {
    /// The case of a sweep at a value of its first axis, the others at their first.
    ///
    /// # Errors
    /// As [`Self::case_at`].
    pub fn case_with(
        &self,
        sweep: &Sweep,
        value: Option<&Value>,
        seed: Option<u64>,
    ) -> Result<Case, RunError> {
        let mut values = sweep.values(0);
        if let (Some(first), Some(value)) = (values.first_mut(), value) {
            *first = value;
        }
        Ok(self.case_at(sweep, &values, seed)?)
    }

    /// Whether the vehicle of a sweep has signals of these names.
    ///
    /// # Errors
    /// It has not, with the nearest name; a case that is refused.
    pub fn has_signals(
        &self,
        sweep: &Sweep,
        names: &[String],
        shared: &Shared,
    ) -> Result<(), RunError> {
        let failed = |source| RunError::of_sweep(sweep, source);
        let case = self.case_with(sweep, None, sweep.seeds.first().copied())?;
        let run = shared.run(&case).map_err(failed)?;
        let all = signals::all(run.vehicle());
        let known = || all.iter().map(Signal::name);
        match names
            .iter()
            .find(|name| !known().any(|other| other == *name))
        {
            Some(unknown) => Err(RunError::Figure {
                sweep: sweep.name.clone(),
                reason: format!("no signal `{unknown}`{}", did_you_mean(unknown, known())),
            }),
            None => Ok(()),
        }
    }
}

/// Runs a case and records signals by their names; a signal that there is not, which [`Study::has_signals`] tells, stays empty.
///
/// # Errors
/// As [`Shared::run`].
pub fn record(case: &Case, names: &[String], shared: &Shared) -> Result<History, VehicleRunError> {
    let mut run = shared.run(case)?;
    let all = signals::all(run.vehicle());
    let named = |name: &String| all.iter().find(|signal| signal.name() == name);
    let chosen: Vec<Option<&Signal>> = names.iter().map(named).collect();
    let mut recorded: Vec<Vec<f64>> = chosen.iter().map(|_| Vec::new()).collect();
    while run.step()?.is_none() {
        let time_s = run.time_s();
        for (values, signal) in recorded.iter_mut().zip(&chosen) {
            values.extend(signal.map(|signal| signal.of(run.state(), time_s)));
        }
    }
    Ok(History {
        step_s: case.step_s,
        signals: recorded,
    })
}
