//! Properties that hold for every motion: passivity, symmetry, clearance, compliance, saving, order and drift.

use dashpot::bench_test::settled_force;
use dashpot::damper;
use dashpot_core::{Damper, DamperParameters, DamperState, Real};
use dashpot_reference::deviation::{errors, root_mean_square};
use proptest::prelude::*;

const STEP_S: f64 = 1e-3;

fn build<T: Real>(parameters: &DamperParameters, step_s: f64) -> Damper<T> {
    parameters.build(step_s).expect("a valid damper")
}

/// A motion of straight segments from 0 through `corners` (m); each segment lasts `ticks`.
fn through(corners: &[f64], ticks: usize) -> Vec<f64> {
    let mut motion = vec![0.0];
    let mut from = 0.0;
    for corner in corners {
        for tick in 1..=ticks {
            motion.push(from + (corner - from) * tick as f64 / ticks as f64);
        }
        from = *corner;
    }
    motion
}

fn corners(amplitude_m: f64) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-amplitude_m..amplitude_m, 4..20)
}

/// Minimum over time of the work put in so far minus the energy `K u^2/2` stored in the springs, divided by the sum of
/// the magnitudes of the work of all ticks (1).
fn min_dissipation(parameters: &DamperParameters, stiffness: f64, motion: &[f64]) -> f64 {
    let damper: Damper<f64> = build(parameters, STEP_S);
    let mut state = damper.at_rest(motion[0]);
    let (mut work, mut moved, mut least) = (0.0_f64, 0.0_f64, 0.0_f64);
    for pair in motion.windows(2) {
        let before = state.force_n();
        let force = damper.step(&mut state, pair[1]);
        let done = 0.5 * (before + force) * (pair[1] - pair[0]);
        work += done;
        moved += done.abs();
        least = least.min(work - 0.5 * force * force / stiffness);
    }
    if moved > 0.0 { least / moved } else { 0.0 }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_energy_comes_out_beyond_the_springs_store(
        corners in corners(8e-3), ticks in 20_usize..200, preset in 0..3_usize,
    ) {
        let (parameters, stiffness) = [
            (damper("paper", &[]), 6e6),
            (damper("reduced-vertical", &["mount.clearance_m=0.0"]), 8e6),
            (damper("reduced-vertical", &[]), 8e6),
        ][preset].clone();
        let least = min_dissipation(&parameters, stiffness, &through(&corners, ticks));
        // The trapezoidal rule has an error in the work where the clearance ends within a tick.
        prop_assert!(least > -1e-3, "{least:e}");
    }

    #[test]
    fn equal_sides_make_an_odd_force_bit_for_bit(
        corners in corners(8e-3), ticks in 5_usize..100,
    ) {
        let parameters = damper("reduced-vertical", &[]);
        odd::<f32>(&parameters, &through(&corners, ticks))?;
        odd::<f64>(&parameters, &through(&corners, ticks))?;
    }

    #[test]
    fn there_is_no_force_in_the_clearance(corners in corners(0.499e-3), ticks in 1_usize..50) {
        for preset in ["paper", "reduced-vertical", "in-service"] {
            let damper: Damper<f32> = build(&damper(preset, &["mount.clearance_m=1e-3"]), STEP_S);
            let mut state = damper.at_rest(0.0);
            for x in through(&corners, ticks) {
                prop_assert_eq!(damper.step(&mut state, x as f32), 0.0);
            }
            prop_assert_eq!(state.piston_displacement_m(), 0.0);
        }
    }

    #[test]
    fn a_softer_valve_never_makes_a_larger_force(
        speed in 0.001..0.3_f64, compression: bool, softer in 1.0..5.0_f64, which in 0..3_usize,
    ) {
        let velocity = if compression { -speed } else { speed };
        let (valve, compliance) = [
            ("piston_extension", 1.36e-11),
            ("piston_compression", 1.37e-11),
            ("foot_compression", 1.446e-12),
        ][which];
        let force = |factor: f64| {
            let set = format!("valves.{valve}.edge_compliance_m_per_pa={:e}", factor * compliance);
            settled_force(&damper("paper", &[set.as_str()]), velocity).abs()
        };
        // Both tables are within 1e-5 of the law.
        prop_assert!(force(softer) <= force(1.0) * (1.0 + 2e-5));
    }

    #[test]
    fn a_restored_state_steps_as_the_saved_one(
        corners in corners(8e-3), ticks in 5_usize..100, cut in 0.0..1.0_f64,
    ) {
        let motion = through(&corners, ticks);
        for preset in ["paper", "reduced-vertical", "in-service"] {
            let damper: Damper<f32> = build(&damper(preset, &[]), STEP_S);
            let cut = (cut * motion.len() as f64) as usize;
            let mut state = damper.at_rest(0.0);
            run(&damper, &mut state, &motion[..cut]);
            let mut restored = state;
            let first = run(&damper, &mut state, &motion[cut..]);
            let second = run(&damper, &mut restored, &motion[cut..]);
            prop_assert_eq!(first, second);
            prop_assert_eq!(state, restored);
        }
    }
}

/// Bits of the forces over the motion.
fn run(damper: &Damper<f32>, state: &mut DamperState<f32>, motion: &[f64]) -> Vec<u32> {
    motion
        .iter()
        .map(|x| damper.step(state, *x as f32).to_bits())
        .collect()
}

fn odd<T: Real>(parameters: &DamperParameters, motion: &[f64]) -> Result<(), TestCaseError> {
    let damper: Damper<T> = build(parameters, STEP_S);
    let (mut one, mut other) = (damper.at_rest(T::ZERO), damper.at_rest(T::ZERO));
    for x in motion {
        let force = damper.step(&mut one, T::from_f64(*x)).to_f64();
        let mirrored = damper.step(&mut other, T::from_f64(-*x)).to_f64();
        prop_assert_eq!(force, -mirrored);
        prop_assert_eq!(
            one.displacement_m().to_f64(),
            -other.displacement_m().to_f64()
        );
    }
    Ok(())
}

/// RMS error of the force (N) at `step_s`, compared at common times with a step 32 times smaller than the smallest
/// used.
fn error(parameters: &DamperParameters, step_s: f64, motion: impl Fn(f64) -> f64) -> f64 {
    const FINE_S: f64 = 1.0 / 65_536.0;
    const DURATION_S: f64 = 1.0;
    let forces = |step_s: f64| {
        let damper: Damper<f64> = build(parameters, step_s);
        let mut state = damper.at_rest(motion(0.0));
        let ticks = (DURATION_S / step_s).round() as usize;
        (0..=ticks)
            .map(|tick| damper.step(&mut state, motion(tick as f64 * step_s)))
            .collect::<Vec<f64>>()
    };
    let (coarse, fine) = (forces(step_s), forces(FINE_S));
    let every = (step_s / FINE_S).round() as usize;
    let fine: Vec<f64> = fine.into_iter().step_by(every).collect();
    root_mean_square(errors(&coarse, &fine))
}

/// Mean order of convergence over three halvings of the step, from `largest_s`.
fn order(parameters: &DamperParameters, largest_s: f64, motion: impl Fn(f64) -> f64) -> f64 {
    let coarse = error(parameters, largest_s, &motion);
    let fine = error(parameters, largest_s / 8.0, &motion);
    (coarse / fine).log2() / 3.0
}

fn harmonic(amplitude_m: f64, frequency_hz: f64) -> impl Fn(f64) -> f64 {
    move |time| amplitude_m * (std::f64::consts::TAU * frequency_hz * time).sin()
}

#[test]
fn halving_the_step_quarters_the_error_of_a_linear_element() {
    let parameters = damper(
        "reduced-vertical",
        &[
            "mount.clearance_m=0.0",
            "reduced.saturation_velocity_m_per_s=0.2",
        ],
    );
    let found = order(&parameters, 1.0 / 256.0, harmonic(2e-3, 3.0));
    assert!((found - 2.0).abs() < 0.05, "{found}");
}

#[test]
fn halving_the_step_quarters_the_error_on_one_side() {
    // The damper is pulled out with a ripple, so that the motion never passes zero after the start.
    let parameters = damper("paper", &[]);
    let ripple = harmonic(1e-3, 4.0);
    let found = order(&parameters, 1.0 / 256.0, |time| {
        0.05 * time * time + 0.08 * time + ripple(time) - 1e-3 * time
    });
    assert!(found > 1.8, "{found}");
}

#[test]
fn halving_the_step_quarters_the_error_through_zero_and_clearance() {
    for (preset, set) in [
        ("paper", "mount.clearance_m=0.0"),
        ("paper", "mount.clearance_m=1e-3"),
        ("reduced-vertical", "mount.clearance_m=1e-3"),
    ] {
        let found = order(&damper(preset, &[set]), 1.0 / 256.0, harmonic(4e-3, 3.0));
        assert!(found > 1.8, "{preset}, {set}: {found}");
    }
}

/// Displacement at a tick of a triangle wave with a period of 2000 ticks, in `f32`.
fn triangle(tick: u32, amplitude_m: f32) -> f32 {
    let phase = tick % 2000;
    let rise = phase.min(2000 - phase) as f32;
    amplitude_m * (rise - 500.0) / 500.0
}

const MANY: u32 = 10_000_000;

#[test]
fn a_piston_at_rest_stays_where_it_is_over_ten_million_steps() {
    let damper: Damper<f32> = build(&damper("reduced-vertical", &[]), STEP_S);
    let mut state = damper.at_rest(0.0);
    let mut early = state;
    for tick in 0..=MANY {
        assert_eq!(damper.step(&mut state, triangle(tick, 0.2e-3)), 0.0);
        if tick == 2000 {
            early = state;
        }
    }
    assert_eq!(MANY % 2000, 0);
    assert_eq!(state, early, "the state after the first cycle, bit for bit");
    assert_eq!(state.piston_displacement_m(), 0.0);
}

#[test]
fn ten_million_steps_in_contact_repeat_every_cycle() {
    let damper: Damper<f32> = build(&damper("in-service", &[]), STEP_S);
    let mut state = damper.at_rest(0.0);
    let mut early = Vec::new();
    for tick in 0..MANY {
        let force = damper.step(&mut state, triangle(tick, 12e-3));
        if tick / 2000 == 1000 {
            early.push(force);
        }
        if tick / 2000 == MANY / 2000 - 1 {
            let before = early[(tick % 2000) as usize];
            assert!(
                (force - before).abs() <= 1e-6 * before.abs(),
                "{before} {force}"
            );
        }
    }
    assert!(
        early
            .iter()
            .fold(0.0_f32, |most, force| most.max(force.abs()))
            > 1e3
    );
}
