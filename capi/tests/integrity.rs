//! Uninitialised memory and damaged memory.

mod common;

use common::core_damper;
use dashpot::*;

const DONE: DashpotError = DashpotError::None;

fn made() -> (DashpotDamper, DashpotState) {
    let core = core_damper(120e3);
    let image = core.to_image();
    let mut damper = DashpotDamper {
        opaque: [0; DASHPOT_DAMPER_WORDS],
    };
    let mut state = DashpotState {
        opaque: [0; DASHPOT_STATE_WORDS],
    };
    // SAFETY: references are valid pointers.
    unsafe {
        assert_eq!(
            dashpot_damper_init(&mut damper, image.as_ptr(), image.len()),
            DONE
        );
        assert_eq!(dashpot_state_init(&mut state, &damper, 0.0), DONE);
    }
    (damper, state)
}

#[test]
fn uninitialised_memory_is_refused_and_unchanged() {
    let (damper, _) = made();
    for word in [0, 0xffff_ffff, 0xa5a5_a5a5, 0xdead_beef, 0xcdcd_cdcd] {
        let mut state = DashpotState {
            opaque: [word; DASHPOT_STATE_WORDS],
        };
        let mut force = [f32::NAN; 2];
        let mut reading = std::mem::MaybeUninit::uninit();
        let mut saved = [0; DASHPOT_SAVED_STATE_SIZE];
        let mut check = DashpotCheck { opaque: [0; 3] };
        // SAFETY: references are valid pointers.
        let codes = unsafe {
            [
                dashpot_step(&damper, &mut state, 0.0, &mut force[0]),
                dashpot_step_bank(&(&raw const damper), &mut state, &0.0, &mut force[1], 1),
                dashpot_state_read(&state, reading.as_mut_ptr()),
                dashpot_state_clear_status(&mut state),
                dashpot_state_save(&state, saved.as_mut_ptr(), saved.len()),
                dashpot_check_slice(&damper, &state, &mut check),
            ]
        };
        assert_eq!(codes, [DashpotError::NoState; 6], "{word:#x}");
        assert_eq!(state.opaque, [word; DASHPOT_STATE_WORDS]);
        assert!(force.iter().all(|force| force.is_nan()), "nothing written");
    }
}

#[test]
fn a_flipped_bit_is_found_and_the_force_stays_within_its_limit() {
    let (mut damper, mut state) = made();
    let mut check = DashpotCheck { opaque: [0; 3] };
    let mut slice = |damper: &DashpotDamper, state: &DashpotState| {
        // SAFETY: references are valid pointers.
        unsafe { dashpot_check_slice(damper, state, &mut check) }
    };
    for _ in 0..2 * DASHPOT_CHECK_SLICES {
        assert_eq!(slice(&damper, &state), DONE);
    }
    damper.opaque[2000] ^= 1 << 30;
    let calls = (1..).find(|_| slice(&damper, &state) != DONE);
    assert!(calls.is_some_and(|calls| calls <= DASHPOT_CHECK_SLICES));
    // Miri is slow, so it tries one word of each part.
    let every = if cfg!(miri) { 397 } else { 1 };
    for word in (0..DASHPOT_DAMPER_WORDS).step_by(every) {
        let (mut damper, mut state) = (damper, state);
        damper.opaque[word] = f32::INFINITY.to_bits();
        for x in [1e-3, -1e-3] {
            let mut force = f32::NAN;
            // SAFETY: references are valid pointers.
            let code = unsafe { dashpot_step(&damper, &mut state, x, &mut force) };
            assert!(
                code == DONE && force.abs() <= 1e7,
                "word {word}: {code:?}, {force} N"
            );
        }
    }
    // An impossible stretch.
    state.opaque[1] = f32::NAN.to_bits();
    assert_eq!(slice(&damper, &state), DashpotError::Corrupted);
}
