//! The fixed step against the reference solver.

use dashpot_core::{DamperParameters, Real};
use serde::Serialize;

use crate::failure::{Failure, Outcome};
use crate::reference::Reference;

/// Deviation of one fixed step from the reference on one motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Deviation {
    /// Step (s).
    pub step_s: f64,
    /// Root mean square error over root mean square reference force (1).
    pub nrmse: f64,
    /// Largest error over the largest reference force (1).
    pub largest_error_over_peak: f64,
    /// Largest error (N).
    pub largest_error_n: f64,
    /// Root mean square of the reference force (N).
    pub reference_rms_n: f64,
    /// Largest magnitude of the reference force (N).
    pub reference_peak_n: f64,
}

/// Largest [`Deviation::nrmse`] the fixed step may have, in `f32` where `single` and in `f64` else, for
/// series stiffnesses up to 14 MN/m: 1e-3 at 1 kHz, 6e-5 and 3e-5 at 10 kHz.
pub fn nrmse_limit(step_s: f64, single: bool) -> f64 {
    match (step_s > 1.1e-4, single) {
        (true, _) => 1e-3,
        (false, true) => 6e-5,
        (false, false) => 3e-5,
    }
}

/// Force (N) of the fixed step at each displacement (m), the first one being where it starts at rest.
///
/// # Errors
/// Parameters that cannot be built.
pub fn fixed_step_forces<T: Real>(
    parameters: &DamperParameters,
    step_s: f64,
    displacements_m: &[f64],
) -> Outcome<Vec<f64>> {
    let damper = parameters.build::<T>(step_s)?;
    let start = displacements_m.first().copied().unwrap_or(0.0);
    let mut state = damper.at_rest(T::from_f64(start));
    Ok(displacements_m
        .iter()
        .map(|&x| damper.step(&mut state, T::from_f64(x)).to_f64())
        .collect())
}

/// Reference force (N) at each displacement (m), linear between ticks of `step_s` (s).
///
/// # Errors
/// What the reference solver reports.
pub fn reference_forces(
    parameters: &DamperParameters,
    step_s: f64,
    displacements_m: &[f64],
) -> Outcome<Vec<f64>> {
    let times: Vec<f64> = (0..displacements_m.len())
        .map(|tick| tick as f64 * step_s)
        .collect();
    Reference::new(parameters)?.forces(&times, displacements_m)
}

/// Deviation of `forces` from `reference` (N).
///
/// # Errors
/// Different lengths, or a reference force that is zero throughout.
pub fn deviation(step_s: f64, forces: &[f64], reference: &[f64]) -> Outcome<Deviation> {
    if forces.len() != reference.len() {
        return Err(Failure::new(format!(
            "{} forces against {} of the reference",
            forces.len(),
            reference.len()
        )));
    }
    let count = reference.len().max(1) as f64;
    let rms = |sum: f64| (sum / count).sqrt();
    let peak = reference.iter().fold(0.0_f64, |peak, f| peak.max(f.abs()));
    if peak == 0.0 {
        return Err(Failure::new(
            "the reference force is zero throughout: the motion stays within the clearance, there is \
             nothing to compare",
        ));
    }
    let errors = || forces.iter().zip(reference).map(|(f, r)| f - r);
    let largest = errors().fold(0.0_f64, |largest, error| largest.max(error.abs()));
    let reference_rms_n = rms(reference.iter().map(|f| f * f).sum());
    Ok(Deviation {
        step_s,
        nrmse: rms(errors().map(|error| error * error).sum()) / reference_rms_n,
        largest_error_over_peak: largest / peak,
        largest_error_n: largest,
        reference_rms_n,
        reference_peak_n: peak,
    })
}
