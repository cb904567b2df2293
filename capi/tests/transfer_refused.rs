//! Wrong calls of the transfer system and its motion filter return a code and change nothing; refused settings are
//! named.

use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use dashpot::*;

const DONE: DashpotError = DashpotError::None;
const STEP_S: f32 = 1e-3;
const MOTION: DashpotMotion = DashpotMotion {
    displacement_m: 0.001,
    velocity_m_per_s: 0.0,
    acceleration_m_per_s2: 0.0,
    jerk_m_per_s3: 0.0,
};
const MEASURED: DashpotMeasured = DashpotMeasured {
    displacement_m: 0.0,
    force_n: 0.0,
};
const COMMAND: DashpotCommand = DashpotCommand {
    command_m: 7.0,
    force_n: 7.0,
    status: 7,
    phase: 7,
};

fn settings() -> DashpotTransferSettings {
    let mut settings = MaybeUninit::uninit();
    // SAFETY: the function writes all settings.
    unsafe {
        let done = dashpot_transfer_settings_init(settings.as_mut_ptr(), 0.05, 0.5, 20e3);
        assert_eq!(done, DONE);
        settings.assume_init()
    }
}

fn never_initialised() -> Box<DashpotTransfer> {
    Box::new(DashpotTransfer {
        opaque: [0xa5a5_a5a5_a5a5_a5a5; DASHPOT_TRANSFER_UNITS],
    })
}

/// The text for settings, cut to `length` bytes.
fn explained(settings: &DashpotTransferSettings, step_s: f32, length: usize) -> String {
    let mut text = [0x7f; 128];
    // SAFETY: the text has room for `length` bytes, and a zero ends it.
    unsafe {
        let done = dashpot_transfer_explain(settings, step_s, text.as_mut_ptr(), length);
        assert_eq!(done, DONE);
        CStr::from_ptr(text.as_ptr()).to_str().unwrap().to_owned()
    }
}

#[test]
fn refused_settings_are_named() {
    type Change = fn(&mut DashpotTransferSettings);
    let cases: [(Change, &str); 9] = [
        (|s| s.guard.ramp_s = 0.0, "guard.ramp_s: 0.01 to 10"),
        (
            |s| s.guard.action = 2,
            "guard.action: DASHPOT_END_HOLD or DASHPOT_END_ZERO_FORCE",
        ),
        (
            |s| s.energy.largest_share = f32::NAN,
            "energy.largest_share: 0.01 to 100",
        ),
        (
            |s| s.tracking_window_s = -1.0,
            "tracking.window_s: 0.05 to 1000",
        ),
        (
            |s| s.compensator = 4,
            "settings.compensator: DASHPOT_COMPENSATOR_NONE to DASHPOT_COMPENSATOR_ADAPTIVE",
        ),
        (
            |s| {
                s.compensator = DASHPOT_COMPENSATOR_POLYNOMIAL;
                s.polynomial_order = 257;
            },
            "polynomial.order: 1 to 3",
        ),
        (
            |s| {
                s.compensator = DASHPOT_COMPENSATOR_INVERSE;
                s.coefficients[1] = 0.3;
            },
            "inverse.a1_s: -0.2 to 0.2",
        ),
        (
            |s| {
                s.compensator = DASHPOT_COMPENSATOR_ADAPTIVE;
                s.adaptive.memory_s = 0.0;
            },
            "adaptive.memory_s: 0.1 to 1000",
        ),
        (
            |s| {
                s.compensator = DASHPOT_COMPENSATOR_ADAPTIVE;
                s.adaptive.noise_m = 1e-7;
                s.adaptive.largest_change = [0.5, 0.2, 0.02, 0.002];
            },
            "adaptive.noise_m: so large that largest_change times the powers of the pole is at most 1e8 noises a metre",
        ),
    ];
    for (change, expected) in cases {
        let mut changed = settings();
        change(&mut changed);
        let mut system = never_initialised();
        // SAFETY: references are valid pointers.
        let code = unsafe { dashpot_transfer_init(&mut *system, &changed, STEP_S) };
        assert_eq!(code, DashpotError::Range, "{expected}");
        assert_eq!(system.opaque, never_initialised().opaque, "{expected}");
        assert_eq!(explained(&changed, STEP_S, 128), expected);
    }
    assert_eq!(explained(&settings(), STEP_S, 128), "");
    let step = explained(&settings(), 1.0, 128);
    assert_eq!(step, "tracking.step_s: 1e-5 to 0.02");
    assert_eq!(explained(&settings(), 1.0, 9), &step[..8]);
    assert_eq!(explained(&settings(), 1.0, 1), "");
}

#[test]
fn wrong_calls_of_a_system_are_codes() {
    let settings = settings();
    let (mut system, mut other) = (never_initialised(), never_initialised());
    let mut command = COMMAND;
    let mut reading = MaybeUninit::<DashpotTransferReading>::uninit();
    // SAFETY: the functions check their arguments and refuse wrong ones.
    unsafe {
        let out: *mut DashpotCommand = &mut command;
        let system: *mut DashpotTransfer = &mut *system;
        for (call, code) in [
            (
                "tick",
                dashpot_transfer_tick(system, &MOTION, &MEASURED, out),
            ),
            ("read", dashpot_transfer_read(system, reading.as_mut_ptr())),
            ("end", dashpot_transfer_end(system)),
            ("clear", dashpot_transfer_clear(system)),
            ("place", dashpot_transfer_place(system, 0.0)),
        ] {
            assert_eq!(code, DashpotError::NoTransfer, "{call}");
        }
        assert_eq!(
            dashpot_transfer_init(null_mut(), &settings, STEP_S),
            DashpotError::NullPointer
        );
        assert_eq!(
            dashpot_transfer_init(system, null(), STEP_S),
            DashpotError::NullPointer
        );
        assert_eq!(
            dashpot_transfer_init(system, system.cast(), STEP_S),
            DashpotError::Overlap
        );
        assert_eq!((*system).opaque, never_initialised().opaque);

        assert_eq!(dashpot_transfer_init(system, &settings, STEP_S), DONE);
        let tick = |desired, measured, out| dashpot_transfer_tick(system, desired, measured, out);
        let inside = system.cast::<u32>().add(40);
        let mut both = [MOTION; 2];
        let both: *mut DashpotMotion = both.as_mut_ptr();
        let far = out.cast::<u8>().wrapping_add(2).cast();
        for (call, code, expected) in [
            (
                "no motion",
                tick(null(), &MEASURED, out),
                DashpotError::NullPointer,
            ),
            (
                "no command",
                tick(&MOTION, &MEASURED, null_mut()),
                DashpotError::NullPointer,
            ),
            (
                "odd measurement",
                tick(&MOTION, far, out),
                DashpotError::Misaligned,
            ),
            (
                "motion in the system",
                tick(inside.cast(), &MEASURED, out),
                DashpotError::Overlap,
            ),
            (
                "measurement in the system",
                tick(&MOTION, inside.cast(), out),
                DashpotError::Overlap,
            ),
            (
                "command in the system",
                tick(&MOTION, &MEASURED, inside.cast()),
                DashpotError::Overlap,
            ),
            (
                "command in the motion",
                tick(both, &MEASURED, both.cast()),
                DashpotError::Overlap,
            ),
            (
                "command in the measurement",
                tick(&MOTION, out.cast(), out),
                DashpotError::Overlap,
            ),
            (
                "place at infinity",
                dashpot_transfer_place(system, f32::INFINITY),
                DashpotError::Range,
            ),
            (
                "reading in the system",
                dashpot_transfer_read(system, inside.cast()),
                DashpotError::Overlap,
            ),
            (
                "no reading",
                dashpot_transfer_read(system, null_mut()),
                DashpotError::NullPointer,
            ),
        ] {
            assert_eq!(code, expected, "{call}");
        }
        assert_eq!(command, COMMAND, "a refused call writes nothing");
        // The refused calls changed nothing: the next tick is that of a new system.
        assert_eq!(dashpot_transfer_init(&mut *other, &settings, STEP_S), DONE);
        let mut expected = COMMAND;
        assert_eq!(tick(&MOTION, &MEASURED, &mut command), DONE);
        let done = dashpot_transfer_tick(&mut *other, &MOTION, &MEASURED, &mut expected);
        assert_eq!((done, command), (DONE, expected));
    }
}

#[test]
fn wrong_calls_for_settings_are_codes() {
    let before = settings();
    let mut changed = before;
    let mut text = [0x7f; 4];
    // SAFETY: the functions check their arguments and refuse wrong ones.
    unsafe {
        for (kind, delay_s, delay_error_s) in [
            (4, 0.01, 0.0),
            (DASHPOT_COMPENSATOR_ADAPTIVE, 0.3, 0.0),
            (DASHPOT_COMPENSATOR_ADAPTIVE, f32::NAN, 0.0),
            (DASHPOT_COMPENSATOR_ADAPTIVE, 0.01, -0.1),
        ] {
            let code =
                dashpot_transfer_settings_set_delay(&mut changed, kind, delay_s, delay_error_s);
            assert_eq!(code, DashpotError::Range, "{kind} {delay_s}");
        }
        assert_eq!(changed, before);
        assert_eq!(
            dashpot_transfer_settings_init(null_mut(), 0.05, 0.5, 20e3),
            DashpotError::NullPointer
        );
        let explain = |text, length| dashpot_transfer_explain(&changed, STEP_S, text, length);
        assert_eq!(explain(text.as_mut_ptr(), 0), DashpotError::Length);
        assert_eq!(explain(null_mut(), 4), DashpotError::NullPointer);
        let inside = (&raw const changed).cast_mut().cast();
        assert_eq!(explain(inside, 4), DashpotError::Overlap);
    }
    assert_eq!(text, [0x7f; 4]);
}

#[test]
fn wrong_calls_of_a_filter_are_codes() {
    let mut filter = DashpotMotionFilter {
        opaque: [0xa5a5_a5a5; DASHPOT_MOTION_FILTER_WORDS],
    };
    let mut motion = MOTION;
    // SAFETY: the functions check their arguments and refuse wrong ones.
    unsafe {
        let filter: *mut DashpotMotionFilter = &mut filter;
        let push = |filter, motion| dashpot_motion_filter_push(filter, 0.1, motion);
        assert_eq!(push(filter, &mut motion), DashpotError::NoTransfer);
        assert_eq!(
            dashpot_motion_filter_rest_at(filter, 0.0),
            DashpotError::NoTransfer
        );
        for (pole_hz, step_s) in [(251.0, 1e-3), (0.5, 1e-3), (10.0, 0.03), (f32::NAN, 1e-3)] {
            assert_eq!(
                dashpot_motion_filter_init(filter, pole_hz, step_s),
                DashpotError::Range
            );
        }
        assert_eq!((*filter).opaque, [0xa5a5_a5a5; DASHPOT_MOTION_FILTER_WORDS]);
        assert_eq!(dashpot_motion_filter_init(filter, 40.0, STEP_S), DONE);
        assert_eq!(
            dashpot_motion_filter_rest_at(filter, f32::NAN),
            DashpotError::Range
        );
        assert_eq!(push(filter, filter.cast()), DashpotError::Overlap);
        assert_eq!(push(null_mut(), &mut motion), DashpotError::NullPointer);
        assert_eq!(motion, MOTION);
        assert_eq!(push(filter, &mut motion), DONE);
        assert_eq!(motion.displacement_m, 0.1);
    }
}
