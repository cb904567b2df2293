//! Fixed bug: one flipped bit in a running state's stretch or displacement left NaN or 1e35 m there, and the force then
//! stayed at -0 or -100 N without a status bit.

use dashpot::damper;
use dashpot::memory::bytes;
use dashpot_core::integrity::Check;
use dashpot_core::{Damper, DamperState, Status, step_bank};

fn displacement(tick: u32) -> f32 {
    5e-3 * (0.02 * tick as f32).sin()
}

/// A running state, and the next tick.
fn running(damper: &Damper<f32>) -> (DamperState<f32>, u32) {
    let mut state = damper.at_rest(0.0);
    for tick in 1..200 {
        damper.step(&mut state, displacement(tick));
    }
    (state, 200)
}

#[test]
fn the_force_is_right_again_soon_after_any_flip() {
    let damper: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    let (sound, start) = running(&damper);
    for bit in 0..64 {
        let (mut sound, mut flipped) = (sound, sound);
        bytes(&mut flipped)[bit / 8] ^= 1 << (bit % 8);
        let impossible = Check::state(&damper, &flipped).is_err();
        for tick in start..start + 600 {
            let right = damper.step(&mut sound, displacement(tick));
            let force = damper.step(&mut flipped, displacement(tick));
            let corrupted = flipped.status().contains(Status::CORRUPTED);
            assert!(tick > start || corrupted == impossible, "bit {bit}");
            let off = (force - right).abs();
            assert!(
                tick < start + 300 || off < 50.0,
                "bit {bit}, tick {tick}: {off} N off"
            );
        }
    }
}

#[test]
fn a_bank_restarts_the_same_damper() {
    let damper: Damper<f32> = damper("in-service", &[]).build(1e-3).expect("a preset");
    let (sound, start) = running(&damper);
    for lane in 0..8 {
        let mut states = [sound; 8];
        bytes(&mut states[lane])[7] ^= 1 << 6; // stretch: 1e38 m
        let mut alone = states;
        let mut forces = [0.0; 8];
        let x = [displacement(start); 8];
        step_bank(&[&damper; 8], &mut states, &x, &mut forces);
        let expected = alone.each_mut().map(|state| damper.step(state, x[0]));
        assert_eq!(forces, expected);
        assert_eq!(states, alone);
        for (index, state) in states.iter().enumerate() {
            let corrupted = state.status().contains(Status::CORRUPTED);
            assert_eq!(corrupted, index == lane);
        }
    }
}
