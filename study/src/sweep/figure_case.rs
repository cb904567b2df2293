//! Cases and signals of figures.

use super::RunError;
use super::shared::Shared;
use super::study::Study;
use dashpot_files::case::Case;
use dashpot_files::did_you_mean;
use dashpot_files::study::{Sweep, Value};
use dashpot_vehicle_run::signals::{self, Signal};

impl Study {
    /// Builds the case of a sweep with the given value of its first axis; the other axes have their first value.
    ///
    /// # Errors
    /// Same errors as [`Self::case_at`].
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

    /// Checks that the vehicle of a sweep has signals with these names.
    ///
    /// # Errors
    /// Returns an error for an unknown signal, with the nearest name, or for an invalid case.
    pub fn check_signals(
        &self,
        sweep: &Sweep,
        names: &[String],
        shared: &Shared,
    ) -> Result<(), RunError> {
        let failed = |source| RunError::in_sweep(sweep, source);
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
