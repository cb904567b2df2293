//! A damper driven beyond its force limit stays at the limit and reports it.

use dashpot::damper;
use dashpot_core::{Damper, Real, Status};
use dashpot_testbench::excitation::Excitation;

/// Counts the ticks at the limit and all ticks close to it, in one direction.
fn plateau<T: Real>(direction: f64, step_s: f64) {
    let built: Damper<T> = damper("paper", &[]).build(step_s).expect("a preset");
    let limit = built.force_limit_n().to_f64();
    let mut state = built.at_rest(T::ZERO);
    let motion = Excitation::Ramp.displacements_m(step_s);
    let forces: Vec<f64> = motion
        .iter()
        .map(|x| direction * built.step(&mut state, T::from_f64(*x)).to_f64())
        .collect();
    let near = forces.iter().filter(|force| **force > 0.98 * limit).count();
    let at = forces.iter().filter(|force| **force == limit).count();
    let label = format!("at {step_s} s in direction {direction}: {at} of {near} ticks");
    assert!(at * 10 > near * 8, "{label}");
    assert!(at as f64 * step_s > 0.05, "{label}");
    assert!(state.status().contains(Status::SATURATED), "{label}");
}

#[test]
fn the_force_stays_at_the_limit() {
    for step_s in [1e-3, 5e-4, 1e-4] {
        for direction in [1.0, -1.0] {
            plateau::<f32>(direction, step_s);
            plateau::<f64>(direction, step_s);
        }
    }
}
