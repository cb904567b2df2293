//! Pairs of wheel and rail of a study.

use super::run::RunError;
use super::study::{Study, StudyCase};
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::{ContactSetup, WheelOnRail};

impl Study {
    /// Distinct pairs of wheel and rail of all cases.
    ///
    /// # Errors
    /// Invalid case.
    pub fn pairs(&self) -> Result<Vec<WheelOnRail>, RunError> {
        let sweeps = self.parameters.sweeps.iter();
        let points = sweeps.flat_map(|sweep| {
            let points = 0..sweep.points();
            points.filter_map(|point| self.case(self.numbers(sweep, point).start))
        });
        let points: Vec<StudyCase<'_>> = points.collect();
        let of_points = dashpot_workers::map(&points, |studied| -> Result<_, RunError> {
            let case = self.case_at(studied.sweep, &studied.values(), None)?;
            let setup = ContactSetup::of_case(&case).map_err(VehicleRunError::from);
            let setup = setup.map_err(|source| RunError::in_sweep(studied.sweep, source))?;
            Ok(setup.pairs().to_vec())
        })?;
        let mut pairs: Vec<WheelOnRail> = Vec::new();
        for pair in of_points.into_iter().flatten() {
            if !pairs.contains(&pair) {
                pairs.push(pair);
            }
        }
        Ok(pairs)
    }
}
