//! The step of a vehicle against the reference solution.

pub mod deviations;
mod error;
mod inside;
pub mod seeds;

pub use error::VerificationError;
pub use inside::{Beside, DamperEffect, Effect, Forces};

use dashpot_reference::vehicle::VehicleReference;

use crate::verification::deviations::Trace;
use dashpot_files::case::Case;
use dashpot_vehicle_run::Sample;
use dashpot_vehicle_run::{Ending, Run};
use dashpot_vehicle_run::{VehicleRunError, contact};

/// Relative tolerance of the reference.
pub const TOLERANCE: f64 = 1e-8;

/// The run in ticks of the case over `every`, told at the ticks of the case.
///
/// # Errors
/// As [`Run::new`].
pub fn stepped(case: &Case, every: u64) -> Result<(Trace, Ending), VehicleRunError> {
    let finer = Case {
        step_s: case.step_s / every as f64,
        ..case.clone()
    };
    let mut run = Run::new(&finer)?;
    let mut trace = Trace::of(&run, case);
    let bodies = trace.accelerations.len();
    loop {
        if let Some(ending) = run.step()? {
            return Ok((trace, ending));
        }
        if run.state().ticks() % every == 0 {
            let state = run.state();
            trace.times_s.push(run.time_s());
            let of_track = (0..bodies).map(|body| state.track_acceleration(body));
            trace.track_accelerations.push(of_track.collect());
            trace.add_state(state);
        }
    }
}

/// The run by the reference at the ticks of `like`, to a relative tolerance.
///
/// # Errors
/// As [`Run::new`]; a tolerance that cannot be reached.
pub fn reference(case: &Case, like: &Trace, tolerance: f64) -> Result<Trace, VerificationError> {
    let contact = contact::tabulated(&case.vehicle, case.friction, case.normal_damping_s_per_m)?;
    let track = case.track.build().map_err(VehicleRunError::from)?;
    let mut solver = VehicleReference::new(
        &case.vehicle,
        &contact,
        &track,
        case.speed_m_per_s,
        case.start_m,
    )?;
    let samples = solver.run(&like.times_s, tolerance)?;
    let mut trace = Trace::new(case);
    trace.times_s.clone_from(&like.times_s);
    for (sample, of_track) in samples.iter().zip(&like.track_accelerations) {
        // An accelerometer does not feel the weight, and feels the curve.
        let acceleration = |body: usize| {
            std::array::from_fn(|i| sample.accelerations[body][i] - of_track[body][i])
        };
        let tick = Sample {
            acceleration,
            unbalanced_m_per_s2: -of_track[0][0],
            contacts: &sample.contacts,
            damper_forces_n: &sample.damper_forces_n,
        };
        trace.add(&tick, &sample.coordinates);
    }
    Ok(trace)
}
