//! Checks of a vehicle run against the reference solution.

pub mod deviations;
mod error;
mod inside;
pub mod seeds;

pub use error::VerificationError;
pub use inside::{DamperEffect, Effect, Forces, InsideComparison};

use dashpot_reference::vehicle::VehicleReference;

use crate::verification::deviations::Trace;
use dashpot_files::case::Case;
use dashpot_vehicle_run::Sample;
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::ContactSetup;
use dashpot_vehicle_run::{Ending, Run};

/// Relative tolerance of the reference solution.
pub const TOLERANCE: f64 = 1e-8;

/// Runs the case with its step size divided by `every`, and records the ticks of the case.
///
/// # Errors
/// Same errors as [`Run::new`].
pub fn stepped(case: &Case, every: u64) -> Result<(Trace, Ending), VehicleRunError> {
    let finer = Case {
        step_s: case.step_s / every as f64,
        ..case.clone()
    };
    let mut run = Run::new(&finer)?;
    let mut trace = Trace::for_run(&run, case);
    let bodies = trace.accelerations.len();
    loop {
        if let Some(ending) = run.step()? {
            return Ok((trace, ending));
        }
        if run.state().ticks() % every == 0 {
            let state = run.state();
            trace.times_s.push(run.time_s());
            let track = (0..bodies).map(|body| state.track_acceleration(body));
            trace.track_accelerations.push(track.collect());
            trace.add_state(state);
        }
    }
}

/// Solves the case with the reference solver at the ticks of `stepped`, to a relative tolerance.
///
/// # Errors
/// Same errors as [`Run::new`]; also an error if the tolerance cannot be reached.
pub fn reference(case: &Case, stepped: &Trace, tolerance: f64) -> Result<Trace, VerificationError> {
    let contacts = ContactSetup::of_case(case).map_err(VehicleRunError::from)?;
    let contacts = contacts.tabulated()?;
    let built_track = case.track.build().map_err(VehicleRunError::from)?;
    let mut solver = VehicleReference::with_contacts(
        &case.vehicle,
        contacts.iter().map(AsRef::as_ref).collect(),
        &built_track,
        case.speed_m_per_s,
        case.start_m,
    )?;
    let samples = solver.run(&stepped.times_s, tolerance)?;
    let mut trace = Trace::new(case);
    trace.times_s.clone_from(&stepped.times_s);
    for (sample, track) in samples.iter().zip(&stepped.track_accelerations) {
        // An accelerometer does not measure gravity, but it does measure the centripetal acceleration in a curve.
        let acceleration =
            |body: usize| std::array::from_fn(|i| sample.accelerations[body][i] - track[body][i]);
        let tick = Sample {
            acceleration,
            unbalanced_m_per_s2: -track[0][0],
            contacts: &sample.contacts,
            damper_forces_n: &sample.damper_forces_n,
        };
        trace.add(&tick, &sample.coordinates);
    }
    Ok(trace)
}
