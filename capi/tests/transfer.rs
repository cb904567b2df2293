//! Calls the transfer system as a C program does: its ticks and readings have the bits of the core, with every kind of
//! compensator, through faults of every kind.

use std::mem::MaybeUninit;
use std::ptr::null;

use dashpot::*;
use dashpot_core::hybrid::{
    AdaptiveSettings, AdaptiveTimeSeries, Compensator, EnergySettings, GuardAction, GuardSettings,
    HybridStatus, InverseModel, Measured, Motion, MotionFilter, PolynomialExtrapolation,
    TransferSettings, TransferSystem, Uncompensated,
};

const DONE: DashpotError = DashpotError::None;
const STEP_S: f32 = 1e-3;
const DELAY_S: f32 = 0.008;
/// Ticks from one fault to the next, and of the whole test; under Miri, which is slow, only the first faults.
const SPAN: u32 = 1000;
const TICKS: u32 = if cfg!(miri) { 300 } else { 13 * SPAN };
/// Tick of a span at which its fault begins; the desired displacement is 0 there.
const FAULT_AT: u32 = 600;

/// Settings as a C program makes them.
fn settings(kind: u32, action: u32) -> DashpotTransferSettings {
    let mut settings = MaybeUninit::uninit();
    // SAFETY: `dashpot_transfer_settings_init` writes all settings.
    unsafe {
        let done = dashpot_transfer_settings_init(settings.as_mut_ptr(), 0.05, 0.5, 20e3);
        assert_eq!(done, DONE);
        let mut settings = settings.assume_init();
        let done = dashpot_transfer_settings_set_delay(&mut settings, kind, DELAY_S, 0.006);
        assert_eq!(done, DONE);
        settings.guard.action = action;
        settings.guard.limited_s = 0.02;
        settings.guard.approach_m_per_s = 0.2;
        settings.guard.without_force_m = 0.02;
        settings.energy.window_s = 0.3;
        settings
    }
}

/// The same settings of the core.
fn core_settings(action: GuardAction) -> TransferSettings {
    TransferSettings {
        guard: GuardSettings {
            action,
            limited_s: 0.02,
            approach_m_per_s: 0.2,
            without_force_m: 0.02,
            ..GuardSettings::new(0.05, 0.5, 20e3)
        },
        energy: EnergySettings {
            window_s: 0.3,
            ..EnergySettings::default()
        },
        tracking_window_s: 1.0,
        tracking_error: 0.3,
    }
}

/// A system in storage with arbitrary content.
fn made(settings: &DashpotTransferSettings) -> Box<DashpotTransfer> {
    let mut system = Box::new(DashpotTransfer {
        opaque: [0x5a5a_5a5a_5a5a_5a5a; DASHPOT_TRANSFER_UNITS],
    });
    // SAFETY: references are valid pointers.
    let done = unsafe { dashpot_transfer_init(&mut *system, settings, STEP_S) };
    assert_eq!(done, DONE);
    system
}

fn tick(
    system: &mut DashpotTransfer,
    desired: &Motion,
    measured: Option<Measured>,
) -> DashpotCommand {
    let desired = DashpotMotion {
        displacement_m: desired.displacement_m,
        velocity_m_per_s: desired.velocity_m_per_s,
        acceleration_m_per_s2: desired.acceleration_m_per_s2,
        jerk_m_per_s3: desired.jerk_m_per_s3,
    };
    let measured = measured.map(|measured| DashpotMeasured {
        displacement_m: measured.displacement_m,
        force_n: measured.force_n,
    });
    let pointer = measured.as_ref().map_or(null(), |measured| measured);
    let mut command = MaybeUninit::uninit();
    // SAFETY: the pointers are those of references, or null where that is allowed; the function writes the command.
    unsafe {
        let done = dashpot_transfer_tick(system, &desired, pointer, command.as_mut_ptr());
        assert_eq!(done, DONE);
        command.assume_init()
    }
}

fn read(system: &DashpotTransfer) -> DashpotTransferReading {
    let mut reading = MaybeUninit::uninit();
    // SAFETY: `dashpot_transfer_read` writes the whole reading.
    unsafe {
        assert_eq!(dashpot_transfer_read(system, reading.as_mut_ptr()), DONE);
        reading.assume_init()
    }
}

/// What is measured from the fault of each span on.
fn with_fault(tick: u32, measured: Measured) -> Option<Measured> {
    let fault = if tick % SPAN < FAULT_AT {
        0
    } else {
        tick / SPAN
    };
    let Measured {
        displacement_m,
        force_n,
    } = measured;
    let (displacement_m, force_n) = match fault {
        1 => return None,
        2 => (f32::NAN, force_n),
        3 => (displacement_m, f32::NEG_INFINITY),
        4 => (displacement_m, -force_n),
        5 => (0.0, force_n),
        6 => (-displacement_m, force_n),
        7 => (displacement_m, 25e3),
        11 => (1.3 * displacement_m, force_n),
        12 => (displacement_m, 1e-3 * force_n),
        _ => (displacement_m, force_n),
    };
    Some(Measured {
        displacement_m,
        force_n,
    })
}

/// The desired displacement: a sine made of parabolas, which becomes too large, not a number, and too fast.
fn desired_m(tick: u32) -> f32 {
    let (half, part) = (200, (tick % 200) as f32 / 200.0);
    let arc = 0.03 * part * (1.0 - part);
    let displacement = if (tick / half).is_multiple_of(2) {
        arc
    } else {
        -arc
    };
    match tick / SPAN {
        8 if tick % SPAN > FAULT_AT => 0.06,
        9 if tick % SPAN == FAULT_AT => f32::NAN,
        10 if tick % SPAN > FAULT_AT => 6.0 * displacement,
        _ => displacement,
    }
}

fn assert_same_reading<C: Compensator>(system: &TransferSystem<C>, found: &DashpotTransferReading) {
    let tracking = system.tracking();
    let expected = [
        tracking.delay_s,
        tracking.amplitude,
        tracking.relative_error,
        tracking.error_m,
        system.energy().added_j(),
        system.energy().added_share(),
    ];
    let found = [
        found.delay_s,
        found.amplitude,
        found.relative_error,
        found.error_m,
        found.added_j,
        found.added_share,
    ];
    assert_eq!(expected.map(f32::to_bits), found.map(f32::to_bits));
}

/// Runs the test with both; returns everything that was noticed, and the last reading.
fn compare<C: Compensator>(
    kind: u32,
    (action, core_action): (u32, GuardAction),
    compensator: C,
) -> (HybridStatus, DashpotTransferReading) {
    let mut core = TransferSystem::new(compensator, &core_settings(core_action), STEP_S).unwrap();
    let mut system = made(&settings(kind, action));
    let mut filter = MotionFilter::new(40.0, STEP_S).unwrap();
    let (mut reached_m, mut velocity_m_per_s) = (0.0, 0.0);
    let (mut noticed, mut random) = (HybridStatus::empty(), 1_u32);
    let mut phases = [false; 4];
    for number in 0..TICKS {
        let x = desired_m(number);
        if !x.is_finite() {
            filter.rest_at(0.0);
        }
        let desired = if x.is_finite() {
            filter.push(x)
        } else {
            Motion::at_rest(x)
        };
        random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = (random >> 8) as f32 / 16_777_216.0 - 0.5;
        let measured = with_fault(
            number,
            Measured {
                displacement_m: reached_m + 2e-6 * noise,
                force_n: 20e3 * velocity_m_per_s + 20.0 * noise,
            },
        );
        let expected = core.tick(&desired, measured);
        let found = tick(&mut system, &desired, measured);
        assert_eq!(
            (
                expected.command_m.to_bits(),
                expected.force_n.to_bits(),
                expected.status.bits()
            ),
            (
                found.command_m.to_bits(),
                found.force_n.to_bits(),
                found.status
            ),
            "tick {number}"
        );
        let guard = core.guard();
        let state = (guard.is_running(), guard.has_ended(), guard.is_held());
        let phase = match found.phase {
            DASHPOT_PHASE_APPROACHING => (false, false, false),
            DASHPOT_PHASE_RUNNING => (true, false, false),
            DASHPOT_PHASE_ENDING => (false, true, false),
            _ => (false, true, true),
        };
        assert_eq!(state, phase, "tick {number}");
        phases[usize::from(found.phase)] = true;
        noticed |= expected.status;
        let change_m = 0.1 * (found.command_m - reached_m);
        reached_m += change_m;
        velocity_m_per_s = change_m / STEP_S;
        if number % SPAN == SPAN - 1 {
            assert_same_reading(&core, &read(&system));
            // SAFETY: references are valid pointers.
            let cleared = unsafe { dashpot_transfer_clear(&mut *system) };
            assert_eq!(cleared == DONE, core.guard().clear(), "tick {number}");
        }
    }
    assert_same_reading(&core, &read(&system));
    assert!(
        cfg!(miri) || phases == [true; 4],
        "not all phases: {phases:?}"
    );
    (noticed, read(&system))
}

const HOLD: (u32, GuardAction) = (DASHPOT_END_HOLD, GuardAction::Hold);
const ZERO_FORCE: (u32, GuardAction) = (DASHPOT_END_ZERO_FORCE, GuardAction::ZeroForce);

#[test]
fn an_adaptive_system_has_the_bits_of_the_core_through_all_faults() {
    let nominal = InverseModel::of_delay(DELAY_S).unwrap().coefficients();
    for action in [HOLD, ZERO_FORCE] {
        let adaptive =
            AdaptiveTimeSeries::new(&AdaptiveSettings::new(nominal, 0.006), STEP_S).unwrap();
        let (noticed, reading) = compare(DASHPOT_COMPENSATOR_ADAPTIVE, action, adaptive);
        let missing = HybridStatus::ENDING
            .difference(noticed)
            .difference(HybridStatus::REQUESTED);
        assert!(
            cfg!(miri) || missing.is_empty(),
            "did not happen: {missing:?}"
        );
        assert!(reading.coefficients[0] > 0.2, "{reading:?}");
    }
}

#[test]
fn other_compensators_have_the_bits_of_the_core() {
    let polynomial = PolynomialExtrapolation::new(3, DELAY_S, STEP_S).unwrap();
    compare(DASHPOT_COMPENSATOR_POLYNOMIAL, HOLD, polynomial);
    let inverse = InverseModel::of_delay(DELAY_S).unwrap();
    let (_, reading) = compare(DASHPOT_COMPENSATOR_INVERSE, HOLD, inverse);
    assert_eq!(reading.coefficients, inverse.coefficients());
    let (_, reading) = compare(DASHPOT_COMPENSATOR_NONE, HOLD, Uncompensated);
    assert_eq!(
        (reading.coefficients, reading.is_frozen),
        ([1.0, 0.0, 0.0, 0.0], 1)
    );
}

#[test]
fn a_motion_filter_has_the_bits_of_the_core() {
    let mut core = MotionFilter::new(40.0, STEP_S).unwrap();
    let mut filter = MaybeUninit::uninit();
    let mut motion = MaybeUninit::uninit();
    core.rest_at(0.01);
    // SAFETY: the functions write what is read afterwards.
    unsafe {
        let filter = filter.as_mut_ptr();
        assert_eq!(dashpot_motion_filter_init(filter, 40.0, STEP_S), DONE);
        assert_eq!(dashpot_motion_filter_rest_at(filter, 0.01), DONE);
        for number in 0..SPAN {
            let x = 0.01 + desired_m(number);
            let expected = core.push(x);
            assert_eq!(
                dashpot_motion_filter_push(filter, x, motion.as_mut_ptr()),
                DONE
            );
            let found: DashpotMotion = motion.assume_init();
            assert_eq!(
                [
                    expected.displacement_m,
                    expected.velocity_m_per_s,
                    expected.acceleration_m_per_s2,
                    expected.jerk_m_per_s3
                ]
                .map(f32::to_bits),
                [
                    found.displacement_m,
                    found.velocity_m_per_s,
                    found.acceleration_m_per_s2,
                    found.jerk_m_per_s3
                ]
                .map(f32::to_bits),
                "tick {number}"
            );
        }
    }
}

#[test]
fn a_requested_end_comes_to_rest_before_it_can_be_cleared() {
    let mut system = made(&settings(DASHPOT_COMPENSATOR_NONE, DASHPOT_END_HOLD));
    let rest = |measured_m| {
        Some(Measured {
            displacement_m: measured_m,
            force_n: 0.0,
        })
    };
    // SAFETY: references are valid pointers.
    unsafe {
        assert_eq!(dashpot_transfer_place(&mut *system, 0.01), DONE);
        let first = tick(&mut system, &Motion::at_rest(0.01), rest(0.01));
        assert_eq!(
            (first.command_m, first.phase),
            (0.01, DASHPOT_PHASE_RUNNING)
        );
        assert_eq!(dashpot_transfer_end(&mut *system), DONE);
        let ending = tick(&mut system, &Motion::at_rest(0.01), rest(0.01));
        assert_eq!(
            (ending.status, ending.phase),
            (DASHPOT_HYBRID_REQUESTED, DASHPOT_PHASE_ENDING)
        );
        assert_eq!(dashpot_transfer_clear(&mut *system), DashpotError::Moving);
        let mut last = ending;
        for _ in 0..300 {
            last = tick(&mut system, &Motion::at_rest(0.01), rest(0.01));
        }
        assert_eq!(last.phase, DASHPOT_PHASE_HELD);
        assert_eq!(dashpot_transfer_clear(&mut *system), DONE);
        let again = tick(&mut system, &Motion::at_rest(0.01), rest(0.01));
        assert_eq!((again.status, again.phase), (0, DASHPOT_PHASE_RUNNING));
    }
}
