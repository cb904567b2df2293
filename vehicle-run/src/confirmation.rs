//! Repeats a run that ended early with shorter steps, to tell a fault of the integration from one of the vehicle.

use std::sync::Arc;

use dashpot_files::case::Case;
use dashpot_rail::vehicle::STEP_S;

use super::{Ending, Run, VehicleRunError};

/// Ratio of the tick to that of the repetition.
const RATIO: f64 = 8.0;

/// The repetition must go on for this long after the ending to refute it, s.
const AFTER_S: f64 = 0.5;

/// Runs that ended later are not repeated, s.
const LONGEST_S: f64 = 100.0;

/// Returns `ended`, or [`Ending::Numerical`] if the run goes on with shorter steps. `run` is the run that ended.
///
/// Only endings of the vehicle itself are examined, within the first 100 s of a run, and only if its tick is at least
/// 40 us, so that it can be divided.
///
/// # Errors
/// Same errors as [`Run::on`].
pub fn confirmed(case: &Case, run: &Run, ended: Ending) -> Result<Ending, VehicleRunError> {
    let place = match &ended {
        Ending::Overturned { place, .. }
        | Ending::Climbed { place, .. }
        | Ending::OutsideTables { place, .. }
        | Ending::BeyondModel { place, .. }
        | Ending::Diverged { place, .. } => *place,
        _ => return Ok(ended),
    };
    let shorter_step_s = (case.step_s / RATIO).max(STEP_S[0]);
    if shorter_step_s > 0.5 * case.step_s || place.time_s > LONGEST_S {
        return Ok(ended);
    }
    let shorter = Case {
        step_s: shorter_step_s,
        ..case.clone()
    };
    let mut repeated = Run::on(&shorter, run.contacts().to_vec(), Arc::clone(run.track()))?;
    while repeated.time_s() < place.time_s + AFTER_S {
        match repeated.step()? {
            None => {}
            Some(Ending::Completed) => break,
            Some(_) => return Ok(ended),
        }
    }
    Ok(Ending::Numerical {
        apparent: Box::new(ended),
        shorter_step_s,
    })
}
