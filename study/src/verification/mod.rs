//! Checks of a vehicle run against the reference solution.

mod compared;
pub mod deviations;
mod error;
mod inside;
pub mod seeds;
mod tick;
mod trace;

pub use error::VerificationError;
pub use inside::{DamperEffect, Effect, Forces, IndexEffect, InsideComparison};
pub use trace::Trace;

use std::sync::Arc;

use dashpot_files::case::Case;
use dashpot_rail::vehicle::Extremes;
use dashpot_reference::vehicle::{VehicleReference, VehicleSample};
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::ContactSetup;
use dashpot_vehicle_run::{Ending, Run, TickRecord};

use tick::ReferenceTick;

/// Relative tolerance of the reference solution. A tenth of it changes the wheel loads of a locomotive by 1 N.
pub const TOLERANCE: f64 = 1e-7;

/// Relative tolerance of a second reference solution, which shows whether a case is chaotic.
pub const LOOSER_TOLERANCE: f64 = 1e-5;

/// Times within a tick at which the reference solution is examined for extremes, at most this far apart, s. With
/// 0.125 ms, the peaks of impacts would be up to 3 % too low.
const SAMPLE_S: f64 = 0.02e-3;

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
    let mut extremes = Vec::new();
    loop {
        if let Some(ending) = run.step()? {
            return Ok((trace, ending));
        }
        extremes.resize(run.vehicle().wheelsets(), Extremes::NONE);
        for (whole, part) in extremes.iter_mut().zip(run.state().extremes()) {
            whole.merge(part);
        }
        if run.state().ticks() % every == 0 {
            let state = run.state();
            trace.times_s.push(run.time_s());
            let track = (0..bodies).map(|body| state.track_acceleration(body));
            trace.track_accelerations.push(track.collect());
            let tick = TickRecord::new(run.time_s(), state);
            trace.add(&tick.with_extremes(std::mem::take(&mut extremes)));
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
    let track = Arc::new(case.track.build().map_err(VehicleRunError::from)?);
    let mut solver = VehicleReference::with_contacts(
        &case.vehicle,
        contacts.iter().map(AsRef::as_ref).collect(),
        &track,
        case.speed_m_per_s,
        case.start_m,
    )?;
    if let Some(support) = case.rails {
        solver = solver.on_flexible_rails(support)?;
    }
    let mut trace = Trace::new(case, &contacts, Arc::clone(&track));
    trace.times_s.clone_from(&stepped.times_s);
    let per_tick = (case.step_s / SAMPLE_S).ceil().max(1.0) as usize;
    let mut times_s = Vec::with_capacity(per_tick * stepped.times_s.len());
    let mut before_s = 0.0;
    for end_s in &stepped.times_s {
        let within = (1..per_tick).map(|k| k as f64 / per_tick as f64);
        times_s.extend(within.map(|part| before_s + part * (end_s - before_s)));
        times_s.push(*end_s);
        before_s = *end_s;
    }
    let mut tick = ReferenceTick::default();
    let mut samples = 0;
    let mut on_sample = |sample: &VehicleSample| {
        if samples % per_tick == 0 {
            tick.begin(sample.contacts.len(), case.speed_m_per_s);
        }
        samples += 1;
        if samples % per_tick != 0 {
            tick.add(sample);
            return;
        }
        let distance_m = case.start_m + case.speed_m_per_s * sample.time_s;
        let of_track = &stepped.track_accelerations[samples / per_tick - 1];
        tick.end(sample, distance_m, of_track);
        trace.add(&tick);
    };
    solver.run_on_tables(&times_s, tolerance, &mut on_sample)?;
    Ok(trace)
}
