//! How far the greatest wheel load depends on the normal damping of the contact, which is an assumed value.

use std::sync::Arc;

use dashpot_files::case::Case;
use serde::Serialize;

use super::contact::ContactSetup;
use super::{Run, VehicleRunError};

/// Ends of the range of the normal damping of steel, s/m: `3/2` times 0.08 and 0.32 s/m (Hunt and Crossley, Journal of
/// Applied Mechanics 42, 1975, 440-445).
pub const STEEL_S_PER_M: [f64; 2] = [0.12, 0.48];

/// Greatest wheel load, relative to the load at standstill, up to which the damping is not examined: without impacts it
/// matters little.
const SMOOTH_RATIO: f64 = 1.8;

/// Longer runs are not repeated, s.
const LONGEST_S: f64 = 100.0;

/// Greatest wheel load of a run with the normal damping of the case and with the ends of its range for steel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DampingInfluence {
    /// Ends of the range, s/m.
    pub damping_s_per_m: [f64; 2],
    /// True if the run was repeated with both ends; false if it takes more than 100 s or the user did not wait.
    pub is_examined: bool,
    /// Greatest wheel load for each, N; `None` if the run did not complete.
    pub greatest_loads_n: [Option<f64>; 2],
    /// Greatest wheel load with the damping of the case, N.
    pub greatest_load_n: f64,
}

impl DampingInfluence {
    /// Repeats a completed run with both ends of the range, unless it takes more than 100 s or `is_cancelled` returns
    /// true; `None` if its greatest load, relative to the load at standstill, shows no impact. `run` is the run.
    ///
    /// # Errors
    /// Same errors as [`Run::on`].
    pub fn of(
        case: &Case,
        run: &Run,
        greatest_load_n: f64,
        ratio: f64,
        is_cancelled: &dyn Fn() -> bool,
    ) -> Result<Option<Self>, VehicleRunError> {
        if ratio <= SMOOTH_RATIO {
            return Ok(None);
        }
        let mut found = Self {
            damping_s_per_m: STEEL_S_PER_M,
            is_examined: false,
            greatest_loads_n: [None; 2],
            greatest_load_n,
        };
        if case.duration_s > LONGEST_S {
            return Ok(Some(found));
        }
        let mut greatest_loads_n = [None; 2];
        for (greatest_n, damping) in greatest_loads_n.iter_mut().zip(STEEL_S_PER_M) {
            let other = Case {
                normal_damping_s_per_m: damping,
                ..case.clone()
            };
            let contacts = ContactSetup::of_case(&other)?.tabulated()?;
            *greatest_n = greatest(
                Run::on(&other, contacts, Arc::clone(run.track()))?,
                is_cancelled,
            )?;
            if is_cancelled() {
                return Ok(Some(found));
            }
        }
        (found.is_examined, found.greatest_loads_n) = (true, greatest_loads_n);
        Ok(Some(found))
    }
}

/// Greatest wheel load of a run, N; `None` if it does not complete or is cancelled.
fn greatest(mut run: Run, is_cancelled: &dyn Fn() -> bool) -> Result<Option<f64>, VehicleRunError> {
    let mut greatest_n = 0.0_f64;
    loop {
        if is_cancelled() {
            return Ok(None);
        }
        if let Some(ending) = run.step()? {
            return Ok((ending == super::Ending::Completed).then_some(greatest_n));
        }
        for extremes in run.state().extremes() {
            let [left, right] = extremes.greatest_loads_n;
            greatest_n = greatest_n.max(left).max(right);
        }
    }
}
