//! The reduced element without clearance and below saturation is a Maxwell element: `K' = K (w tau)^2/(1 + (w tau)^2)`,
//! `C_dyn = C/(1 + (w tau)^2)`, `tau = C/K`.

use std::f64::consts::TAU;

use dashpot::bench_test::{Harmonic, Indices, settled_cycle};
use dashpot::damper;

const STEP_S: f64 = 1e-4;
const DAMPING: f64 = 120e3;

fn cycle(stiffness: f64, frequency_hz: f64) -> Indices {
    let stiffness = format!("mount.stiffness_n_per_m={stiffness:e}");
    let parameters = damper(
        "reduced-vertical",
        &[
            &stiffness,
            "mount.clearance_m=0.0",
            // A Maxwell element has no saturation.
            "reduced.saturation_velocity_m_per_s=1.0",
            "limits.force_n=1e6",
        ],
    );
    let motion = Harmonic {
        amplitude_m: 2e-3,
        frequency_hz,
    };
    settled_cycle(&parameters, motion, STEP_S)
}

fn maxwell(stiffness: f64, frequency_hz: f64) -> (f64, f64) {
    let square = (TAU * frequency_hz * DAMPING / stiffness).powi(2);
    (
        stiffness * square / (1.0 + square),
        DAMPING / (1.0 + square),
    )
}

#[test]
fn stiffness_and_damping_follow_maxwell_over_frequency() {
    for stiffness in [2e6, 8e6, 40e6] {
        for frequency in [0.5, 2.0, 10.0, 40.0] {
            let found = cycle(stiffness, frequency);
            let (storage, damping) = maxwell(stiffness, frequency);
            // Both errors are fractions of the total dynamic stiffness, and of second order in the step.
            let angular = TAU * frequency;
            let whole = storage.hypot(angular * damping);
            let tolerance = 5e-6 + 0.2 * (angular * STEP_S).powi(2);
            let share = (found.storage_stiffness_n_per_m - storage).abs() / whole;
            assert!(
                share < tolerance,
                "K' at {stiffness} N/m, {frequency} Hz: {share:e}"
            );
            let share = angular * (found.dynamic_damping_n_s_per_m - damping).abs() / whole;
            assert!(
                share < tolerance,
                "C_dyn at {stiffness} N/m, {frequency} Hz: {share:e}"
            );
        }
    }
}

#[test]
fn a_stiff_spring_leaves_the_damper() {
    let found = cycle(1e9, 2.0);
    assert!((found.dynamic_damping_n_s_per_m / DAMPING - 1.0).abs() < 1e-5);
    // tau w = 1.5e-3
    assert!(found.storage_stiffness_n_per_m < 3e-6 * 1e9);
}

#[test]
fn a_soft_spring_leaves_the_spring() {
    const STIFFNESS: f64 = 2e4;
    // With tau = 6 s, the spring takes all of the motion except 1/(w tau)^2 = 4e-7. The initial transient decays
    // slowly, by 1/240 per cycle.
    let found = cycle(STIFFNESS, 40.0);
    assert!((found.storage_stiffness_n_per_m / STIFFNESS - 1.0).abs() < 1e-3);
    assert!(found.dynamic_damping_n_s_per_m < 1e-3 * DAMPING);
}

#[test]
fn energy_of_a_cycle_is_pi_c_dyn_w_x0_squared() {
    let found = cycle(8e6, 2.0);
    let (_, damping) = maxwell(8e6, 2.0);
    let expected = std::f64::consts::PI * damping * TAU * 2.0 * 4e-6;
    assert!((found.energy_per_cycle_j / expected - 1.0).abs() < 1e-5);
}
