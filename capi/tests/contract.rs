//! Calls the C functions as a C program does: the results are bit-identical to those of the core, and each wrong call
//! returns a code.

mod common;

use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use common::core_damper;
use dashpot::*;
use dashpot_core::{Damper, Status};

const IMAGE: usize = DASHPOT_IMAGE_SIZE;
const SAVED: usize = DASHPOT_SAVED_STATE_SIZE;
const DONE: DashpotError = DashpotError::None;

/// Under Miri, which is slow, the tests use only one of this many ticks or bits.
const EVERY: usize = if cfg!(miri) { 50 } else { 1 };

/// Initialises a damper from the image of `core`, in storage with arbitrary content.
fn made(core: &Damper<f32>) -> DashpotDamper {
    let mut damper = DashpotDamper {
        opaque: [0xdead_beef; DASHPOT_DAMPER_WORDS],
    };
    let image = core.to_image();
    // SAFETY: the arguments are what the function requires.
    let done = unsafe { dashpot_damper_init(&mut damper, image.as_ptr(), image.len()) };
    assert_eq!(done, DONE);
    damper
}

fn at_rest(damper: &DashpotDamper, displacement_m: f32) -> DashpotState {
    let mut state = MaybeUninit::uninit();
    // SAFETY: `dashpot_state_init` writes the whole state.
    unsafe {
        assert_eq!(
            dashpot_state_init(state.as_mut_ptr(), damper, displacement_m),
            DONE
        );
        state.assume_init()
    }
}

fn step(damper: &DashpotDamper, state: &mut DashpotState, displacement_m: f32) -> f32 {
    let mut force = f32::NAN;
    // SAFETY: references are valid pointers.
    let done = unsafe { dashpot_step(damper, state, displacement_m, &mut force) };
    assert_eq!(done, DONE);
    force
}

fn read(state: &DashpotState) -> DashpotReading {
    let mut reading = MaybeUninit::uninit();
    // SAFETY: `dashpot_state_read` writes the whole reading.
    unsafe {
        assert_eq!(dashpot_state_read(state, reading.as_mut_ptr()), DONE);
        reading.assume_init()
    }
}

fn save(state: &DashpotState) -> [u8; SAVED] {
    let mut saved = [0; SAVED];
    // SAFETY: references are valid pointers.
    let done = unsafe { dashpot_state_save(state, saved.as_mut_ptr(), SAVED) };
    assert_eq!(done, DONE);
    saved
}

fn restore(damper: &DashpotDamper, state: &mut DashpotState, saved: &[u8]) -> DashpotError {
    // SAFETY: references are valid pointers.
    unsafe { dashpot_state_restore(state, damper, saved.as_ptr(), saved.len()) }
}

/// 2 mm at 2 Hz, with faulty sensor values and with jumps within and beyond the range.
fn displacement(tick: u32) -> f32 {
    match tick {
        200 => f32::NAN,
        300 => f32::NEG_INFINITY,
        400 => 5.0,
        600 => 0.01,
        // Arcs of 2 mm, computed with operations that give the same bits on every machine.
        _ => {
            let phase = (tick % 500) as f32 / 250.0 - 1.0;
            8e-3 * phase * (1.0 - phase.abs())
        }
    }
}

#[test]
fn steps_have_the_bits_of_the_core() {
    let core = core_damper(120e3);
    let damper = made(&core);
    let (mut state, mut expected) = (at_rest(&damper, 1e-3), core.at_rest(1e-3));
    for tick in (0..1000).step_by(EVERY) {
        let force = step(&damper, &mut state, displacement(tick));
        assert_eq!(
            force.to_bits(),
            core.step(&mut expected, displacement(tick)).to_bits()
        );
        let reading = read(&state);
        assert_eq!(reading.force_n, expected.force_n());
        assert_eq!(reading.displacement_m, expected.displacement_m());
        assert_eq!(reading.status, expected.status().bits());
        assert_eq!(reading.rejected_inputs, expected.rejected_inputs());
    }
    let reading = read(&state);
    let held_and_limited = DASHPOT_STATUS_INPUT_HELD | DASHPOT_STATUS_INPUT_LIMITED;
    assert_eq!(reading.status & held_and_limited, held_and_limited);
    assert!(reading.rejected_inputs >= 3);
    // SAFETY: references are valid pointers.
    assert_eq!(unsafe { dashpot_state_clear_status(&mut state) }, DONE);
    assert_eq!((read(&state).status, read(&state).rejected_inputs), (0, 0));
    assert_eq!(read(&state).force_n, reading.force_n);
}

#[test]
fn a_bank_has_the_bits_of_its_dampers_also_in_place() {
    let cores = [core_damper(120e3), core_damper(80e3)];
    let made = cores.map(|core| made(&core));
    let dampers: [*const DashpotDamper; 5] =
        std::array::from_fn(|index| &raw const made[index % 2]);
    let mut states = [at_rest(&made[0], 0.0); 5];
    let mut expected = [cores[0].at_rest(0.0); 5];
    for tick in (0..500).step_by(EVERY) {
        let displacements: [f32; 5] =
            std::array::from_fn(|index| displacement(tick) * index as f32);
        let forces: [f32; 5] =
            std::array::from_fn(|i| cores[i % 2].step(&mut expected[i], displacements[i]));
        let mut exchanged = displacements;
        let place = exchanged.as_mut_ptr();
        // SAFETY: there are five of each; displacements and forces can be the same array.
        let done =
            unsafe { dashpot_step_bank(dampers.as_ptr(), states.as_mut_ptr(), place, place, 5) };
        assert_eq!(done, DONE);
        assert_eq!(exchanged.map(f32::to_bits), forces.map(f32::to_bits));
    }
    assert!(read(&states[1]).status & DASHPOT_STATUS_DAMPER_SWAPPED != 0);
    let before = states.map(|state| state.opaque);
    let mut forces = [7.0; 5];
    let none = DashpotDamper {
        opaque: [0; DASHPOT_DAMPER_WORDS],
    };
    for (last, code) in [
        (null(), DashpotError::NullPointer),
        (&raw const none, DashpotError::NoDamper),
        (dampers[0].wrapping_byte_add(1), DashpotError::Misaligned),
    ] {
        let mut dampers = dampers;
        dampers[4] = last;
        // SAFETY: there are five of each; the wrong pointer is not dereferenced.
        let refused = unsafe {
            dashpot_step_bank(
                dampers.as_ptr(),
                states.as_mut_ptr(),
                [1e-3; 5].as_ptr(),
                forces.as_mut_ptr(),
                5,
            )
        };
        assert_eq!(refused, code);
        assert_eq!(
            states.map(|state| state.opaque),
            before,
            "one wrong, none stepped"
        );
        assert_eq!(forces, [7.0; 5]);
    }
}

#[test]
fn a_saved_state_is_the_same_in_c_and_in_rust() {
    let core = core_damper(120e3);
    let damper = made(&core);
    let (mut state, mut expected) = (at_rest(&damper, 0.0), core.at_rest(0.0));
    for tick in 0..100 {
        step(&damper, &mut state, displacement(tick));
        core.step(&mut expected, displacement(tick));
    }
    let mut saved = [0; DASHPOT_SAVED_STATE_SIZE];
    // SAFETY: references are valid pointers.
    let done = unsafe { dashpot_state_save(&state, saved.as_mut_ptr(), saved.len()) };
    assert_eq!(done, DONE);
    assert_eq!(saved, expected.save());
    assert_eq!(core.restore(&saved), Ok(expected));
}

#[test]
fn a_live_change_of_the_clearance_has_the_bits_of_the_core() {
    let mut core = core_damper(120e3);
    let mut damper = made(&core);
    let (mut state, mut expected) = (at_rest(&damper, 0.0), core.at_rest(0.0));
    for tick in (0..500).step_by(EVERY) {
        if tick == 250 {
            core.set_clearance_m(3e-3).unwrap();
            // SAFETY: references are valid pointers.
            let done = unsafe { dashpot_damper_set_clearance(&mut damper, 3e-3) };
            assert_eq!(done, DONE);
        }
        let force = step(&damper, &mut state, displacement(tick));
        assert_eq!(
            force.to_bits(),
            core.step(&mut expected, displacement(tick)).to_bits()
        );
    }
    assert!(read(&state).status & DASHPOT_STATUS_DAMPER_SWAPPED != 0);
    for wrong in [-1e-6, 0.100_01, f32::NAN, f32::INFINITY] {
        let before = damper.opaque;
        // SAFETY: references are valid pointers.
        let refused = unsafe { dashpot_damper_set_clearance(&mut damper, wrong) };
        assert_eq!(refused, DashpotError::Range, "{wrong}");
        assert_eq!(damper.opaque, before);
    }
    let mut info = DashpotDamperInfo {
        step_s: 0.0,
        clearance_m: 0.0,
        force_limit_n: 0.0,
        revision: 0,
    };
    // SAFETY: references are valid pointers.
    assert_eq!(unsafe { dashpot_damper_describe(&damper, &mut info) }, DONE);
    assert_eq!((info.step_s, info.clearance_m), (1e-3, 3e-3));
    assert!(
        (info.force_limit_n - 3600.0).abs() < 0.1,
        "C v = 120e3 * 0.03"
    );
    assert_eq!(info.revision, core.revision());
}

#[test]
fn a_wrong_image_leaves_the_damper_unchanged() {
    let core = core_damper(120e3);
    let mut damper = made(&core);
    let before = damper.opaque;
    let mut init = |image: &[u8], length: usize| {
        // SAFETY: `length` is at most the length of the image.
        let code = unsafe { dashpot_damper_init(&mut damper, image.as_ptr(), length) };
        assert_eq!(damper.opaque, before);
        code
    };
    let good = core.to_image();
    for length in [0, 1, 15, 16, 19, IMAGE - 1] {
        assert_eq!(init(&good, length), DashpotError::Length, "{length}");
    }
    for (at, code) in [
        (0, DashpotError::Magic),
        (4, DashpotError::ByteOrder),
        (6, DashpotError::Version),
        (8, DashpotError::Scalar),
        (12, DashpotError::Length),
        (16, DashpotError::Checksum),
        (IMAGE / 2, DashpotError::Checksum),
        (IMAGE - 1, DashpotError::Checksum),
    ] {
        for bit in (0..8).step_by(EVERY) {
            let mut image = good;
            image[at] ^= 1 << bit;
            assert_eq!(init(&image, IMAGE), code, "byte {at} bit {bit}");
        }
    }
    // Reads the image at an odd address.
    let mut shifted = vec![0];
    shifted.extend(good);
    assert_eq!(init(&shifted[1..], IMAGE), DONE);
}

#[test]
fn a_restored_state_steps_identically() {
    let damper = made(&core_damper(120e3));
    let mut state = at_rest(&damper, 0.0);
    for tick in (0..600).step_by(EVERY) {
        if tick % 50 == 0 {
            let saved = save(&state);
            let mut restored = DashpotState {
                opaque: [u32::MAX; DASHPOT_STATE_WORDS],
            };
            assert_eq!(restore(&damper, &mut restored, &saved), DONE);
            assert_eq!(restored.opaque, state.opaque);
        }
        step(&damper, &mut state, displacement(tick));
    }
}

#[test]
fn a_wrong_saved_state_changes_nothing() {
    let damper = made(&core_damper(120e3));
    let mut state = at_rest(&damper, 0.0);
    let force = step(&damper, &mut state, 1e-3);
    assert!(force > 0.0);
    let saved = save(&state);
    let before = state.opaque;
    for bit in 0..8 * SAVED {
        let mut wrong = saved;
        wrong[bit / 8] ^= 1 << (bit % 8);
        let expected = match bit / 8 {
            0..4 => DashpotError::Magic,
            4..6 => DashpotError::Version,
            6..8 => DashpotError::Scalar,
            _ => DashpotError::Checksum,
        };
        assert_eq!(restore(&damper, &mut state, &wrong), expected, "bit {bit}");
        assert_eq!(state.opaque, before);
    }
    for length in 0..SAVED {
        assert_eq!(
            restore(&damper, &mut state, &saved[..length]),
            DashpotError::Length
        );
    }
    let longer: Vec<u8> = saved.iter().copied().chain([0]).collect();
    assert_eq!(restore(&damper, &mut state, &longer), DashpotError::Length);
    let other = made(&core_damper(80e3));
    assert_eq!(
        restore(&other, &mut state, &saved),
        DashpotError::WrongDamper
    );
    // An impossible state with a correct CRC-32.
    let mut forged = state;
    forged.opaque[3] = f32::NAN.to_bits();
    assert_eq!(
        restore(&damper, &mut state, &save(&forged)),
        DashpotError::Values
    );
    assert_eq!(state.opaque, before);
}

/// Makes each pointer of each function first null and then misaligned, while the others are valid.
#[test]
fn null_and_misaligned_pointers_are_codes() {
    let core = core_damper(120e3);
    let image = core.to_image();
    let mut damper = made(&core);
    let mut state = at_rest(&damper, 0.0);
    let saved = save(&state);
    let mut bytes = [0_u8; SAVED];
    let mut reading = read(&state);
    let mut info = DashpotDamperInfo {
        step_s: 0.0,
        clearance_m: 0.0,
        force_limit_n: 0.0,
        revision: 0,
    };
    let (mut force, x) = (0.0_f32, 1e-3_f32);
    let (damper, state): (*mut DashpotDamper, *mut DashpotState) =
        (&raw mut damper, &raw mut state);
    let list = [damper.cast_const()];
    let (reading, info) = (&raw mut reading, &raw mut info);
    let (force, x) = (&raw mut force, &raw const x);
    let (to, from, image) = (bytes.as_mut_ptr(), saved.as_ptr(), image.as_ptr());
    let dampers = list.as_ptr();

    const NULL: DashpotError = DashpotError::NullPointer;
    const ODD: DashpotError = DashpotError::Misaligned;
    macro_rules! wrong_pointers {
        ($($call:ident($($before:expr),*; $pointer:expr; $($after:expr),*);)*) => {
            $(
                // SAFETY: other pointers are valid; null and misaligned ones are not dereferenced.
                let (null, odd, right) = unsafe {(
                    $call($($before,)* none($pointer), $($after),*),
                    $call($($before,)* $pointer.wrapping_byte_add(1), $($after),*),
                    $call($($before,)* $pointer, $($after),*),
                )};
                assert_eq!((null, odd, right), (NULL, ODD, DONE), stringify!($call, $pointer));
            )*
        };
    }
    /// Returns a null pointer of the type of `_like`.
    fn none<P: Null>(_like: P) -> P {
        P::NULL
    }
    trait Null {
        const NULL: Self;
    }
    impl<T> Null for *const T {
        const NULL: Self = null();
    }
    impl<T> Null for *mut T {
        const NULL: Self = null_mut();
    }
    wrong_pointers! {
        dashpot_damper_init(; damper; image, IMAGE);
        dashpot_damper_describe(; damper.cast_const(); info);
        dashpot_damper_describe(damper; info;);
        dashpot_damper_set_clearance(; damper; 1e-3);
        dashpot_state_init(; state; damper, 0.0);
        dashpot_state_init(state; damper.cast_const(); 0.0);
        dashpot_step(; damper.cast_const(); state, 0.0, force);
        dashpot_step(damper; state; 0.0, force);
        dashpot_step(damper, state, 0.0; force;);
        dashpot_step_bank(; dampers; state, x, force, 1);
        dashpot_step_bank(dampers; state; x, force, 1);
        dashpot_step_bank(dampers, state; x; force, 1);
        dashpot_step_bank(dampers, state, x; force; 1);
        dashpot_state_read(; state.cast_const(); reading);
        dashpot_state_read(state; reading;);
        dashpot_state_clear_status(; state;);
        dashpot_state_save(; state.cast_const(); to, SAVED);
        dashpot_state_init(; state; damper, 0.0);
        dashpot_state_restore(; state; damper, from, SAVED);
        dashpot_state_restore(state; damper.cast_const(); from, SAVED);
    }
    // Bytes need no alignment.
    const LENGTH: DashpotError = DashpotError::Length;
    const RANGE: DashpotError = DashpotError::Range;
    // SAFETY: pointers that are not null are valid; an impossible length is not used.
    unsafe {
        assert_eq!(dashpot_state_save(state, null_mut(), SAVED), NULL);
        assert_eq!(dashpot_state_save(state, to, SAVED - 1), LENGTH);
        assert_eq!(dashpot_state_restore(state, damper, null(), SAVED), NULL);
        assert_eq!(dashpot_damper_init(damper, null(), IMAGE), NULL);
        assert_eq!(dashpot_damper_init(damper, image, usize::MAX), LENGTH);
        assert_eq!(dashpot_step_bank(dampers, state, x, force, 0), DONE);
        assert_eq!(
            dashpot_step_bank(dampers, state, x, force, usize::MAX),
            LENGTH
        );
        assert_eq!(dashpot_state_init(state, damper, f32::NAN), RANGE);
        assert_eq!(dashpot_state_init(state, damper, 0.51), RANGE);
    }
}

#[test]
fn storage_without_a_damper_is_refused() {
    let none = DashpotDamper {
        opaque: [0; DASHPOT_DAMPER_WORDS],
    };
    let mut state = DashpotState {
        opaque: [0; DASHPOT_STATE_WORDS],
    };
    let mut force = 0.0;
    // SAFETY: references are valid pointers.
    unsafe {
        assert_eq!(
            dashpot_state_init(&mut state, &none, 0.0),
            DashpotError::NoDamper
        );
        assert_eq!(
            dashpot_step(&none, &mut state, 0.0, &mut force),
            DashpotError::NoDamper
        );
    }
}

#[test]
fn every_code_has_its_own_text_and_no_other_number_crashes() {
    const UNKNOWN: &str = "unknown code";
    // SAFETY: the text is static and ends with a zero.
    let found = |code| unsafe { CStr::from_ptr(dashpot_error_text(code)) };
    let text = |code| found(code).to_str().unwrap();
    let mut texts: Vec<&str> = Vec::new();
    assert!(DashpotError::ALL.is_sorted_by_key(|error| *error as i32));
    for error in DashpotError::ALL {
        let text = text(error as i32);
        assert!(!texts.contains(&text) && text != UNKNOWN, "{text}");
        texts.push(text);
    }
    let last = DashpotError::ALL.last().unwrap();
    for code in [-1, *last as i32 + 1, i32::MIN, i32::MAX] {
        assert_eq!(text(code), UNKNOWN);
    }
}

#[test]
fn the_status_bits_are_all_the_core_has() {
    let all = DASHPOT_STATUS_INPUT_HELD
        | DASHPOT_STATUS_INPUT_LIMITED
        | DASHPOT_STATUS_SATURATED
        | DASHPOT_STATUS_DAMPER_SWAPPED
        | DASHPOT_STATUS_CORRUPTED
        | DASHPOT_STATUS_RESTARTED;
    assert_eq!(Status::from_bits_truncate(u16::MAX).bits(), all);
}
