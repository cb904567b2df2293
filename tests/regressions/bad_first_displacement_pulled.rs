//! Fixed bug: a state could be put at rest at any finite displacement, from which the step then moved to the next one
//! at the maximum rate. After a first sample of 1 m, a motion of 10 mm met up to 50 kN for half a second; after a first
//! sample of 1e6 m, there was never a force again.

use dashpot::damper;
use dashpot_core::{Damper, Status};

fn displacement(tick: u32) -> f32 {
    10e-3 * (0.03 * tick as f32).sin()
}

#[test]
fn after_a_bad_first_displacement_the_damper_is_at_rest_at_the_first_good_one() {
    let damper: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    for first in [1.0, 1e6, -1.0, 0.4, -0.1, f32::NAN, f32::INFINITY, f32::MAX] {
        let mut state = damper.at_rest(first);
        let mut right = damper.at_rest(displacement(1));
        for tick in 1..2000 {
            let force = damper.step(&mut state, displacement(tick));
            let expected = damper.step(&mut right, displacement(tick));
            assert_eq!(force, expected, "{first}, tick {tick}");
        }
        assert!(state.status().contains(Status::RESTARTED), "{first}");
        let rejected = first.abs() <= damper.largest_displacement_m();
        assert_eq!(
            state.status().contains(Status::INPUT_HELD),
            !rejected,
            "{first}"
        );
    }
}

#[test]
fn a_displacement_out_of_range_is_held_however_it_comes() {
    let damper: Damper<f32> = damper("in-service", &["limits.displacement_m=0.1"])
        .build(1e-3)
        .expect("a preset");
    let mut state = damper.at_rest(0.0);
    // The motion passes the end of the range at 0.5 m/s.
    for tick in 1..=400 {
        damper.step(&mut state, 0.5e-3 * tick as f32);
    }
    assert_eq!(
        (state.displacement_m(), state.rejected_inputs()),
        (0.1, 200)
    );
    assert!(state.status().contains(Status::INPUT_HELD));
    assert!(!state.status().contains(Status::RESTARTED));
    let rest = state.force_n();
    assert!(rest < 500.0, "{rest} N at rest");
}

#[test]
fn a_jump_too_far_to_catch_up_with_ends_at_rest_there() {
    let damper: Damper<f64> = damper("in-service", &[]).build(1e-3).expect("a preset");
    let mut state = damper.at_rest(0.0);
    for tick in 1..=100 {
        damper.step(&mut state, 2e-4 * f64::from(tick));
    }
    let before = state.force_n();
    assert!(before > 5e3, "{before} N");
    // One sample 60 mm away, then back.
    let mut glitch = state;
    let held = damper.step(&mut glitch, 0.08);
    assert!(held > 0.0 && held < before, "{held} N");
    let after = damper.step(&mut glitch, 0.0202);
    assert!((after - before).abs() < 0.3 * before, "{after} N");
    assert!(!glitch.status().contains(Status::RESTARTED));
    // Now the input stays 60 mm away.
    let mut ticks = 0;
    while !state.status().contains(Status::RESTARTED) {
        let last = state.force_n();
        let force = damper.step(&mut state, 0.08);
        assert!(force < last, "the force falls");
        ticks += 1;
        assert!(ticks <= 11, "10 ms, and the tick that restarts");
    }
    assert_eq!((state.displacement_m(), state.force_n()), (0.08, 0.0));
    assert_eq!(u32::from(state.rejected_inputs()), ticks);
}
