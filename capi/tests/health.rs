//! Calls the health estimator as a C program does: the results are bit-identical to those of the core, and each wrong
//! call returns a code.

use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use dashpot::*;
use dashpot_core::Damper;
use dashpot_core::health::{Health, HealthModel, HealthSettings};
use dashpot_core::parameters::{DamperParameters, Mount};

const DONE: DashpotError = DashpotError::None;

fn core_model() -> (Damper<f32>, HealthModel) {
    let checked = DamperParameters::reduced(120e3, 0.03, Mount::new(8e6))
        .check()
        .unwrap();
    let settings = HealthSettings::new(50e-6, 50.0);
    (
        checked.build(1e-3).unwrap(),
        checked.health_model(&settings, 1e-3).unwrap(),
    )
}

fn made(model: &HealthModel) -> DashpotHealthModel {
    let image = model.to_image();
    let mut made = MaybeUninit::uninit();
    // SAFETY: `dashpot_health_model_init` writes the whole model.
    unsafe {
        let done = dashpot_health_model_init(made.as_mut_ptr(), image.as_ptr(), image.len());
        assert_eq!(done, DONE);
        made.assume_init()
    }
}

fn begun(model: &DashpotHealthModel) -> DashpotHealth {
    let mut health = MaybeUninit::uninit();
    // SAFETY: `dashpot_health_init` writes the whole estimate.
    unsafe {
        assert_eq!(dashpot_health_init(health.as_mut_ptr(), model), DONE);
        health.assume_init()
    }
}

fn read(model: &DashpotHealthModel, health: &DashpotHealth) -> DashpotHealthReading {
    let mut reading = MaybeUninit::uninit();
    // SAFETY: `dashpot_health_read` writes the whole reading.
    unsafe {
        assert_eq!(
            dashpot_health_read(model, health, reading.as_mut_ptr()),
            DONE
        );
        reading.assume_init()
    }
}

#[test]
fn estimates_have_the_bits_of_the_core() {
    let (damper, core) = core_model();
    let mut model = made(&core);
    let mut health = begun(&model);
    let mut expected = Health::new(&core);
    let mut state = damper.at_rest(0.0);
    for tick in 0..5000 {
        // Arcs of 2 mm and 0.5 mm, computed with operations that give the same bits on every machine.
        let arc = |period: i32| {
            let phase = (tick % period) as f32 / (0.5 * period as f32) - 1.0;
            phase * (1.0 - phase.abs())
        };
        let x = 8e-3 * arc(700) + 2e-3 * arc(130);
        let force = damper.step(&mut state, x);
        let x = if tick == 2000 { f32::NAN } else { x };
        expected.tick(&core, x, force);
        // SAFETY: references are valid pointers.
        let done = unsafe { dashpot_health_tick(&model, &mut health, x, force) };
        assert_eq!(done, DONE);
    }
    let (reading, expected) = (read(&model, &health), expected.reading(&core));
    let same = |ours: DashpotEstimate, theirs: dashpot_core::health::Estimate| {
        assert_eq!(ours.value.to_bits(), theirs.value.to_bits());
        assert_eq!(ours.sd.to_bits(), theirs.sd.to_bits());
    };
    same(reading.flow_factor, expected.flow_factor);
    same(reading.stiffness_n_per_m, expected.stiffness_n_per_m);
    same(reading.clearance_m, expected.clearance_m);
    same(reading.lag_s, expected.lag_s);
    same(reading.compliance_m_per_n, expected.compliance_m_per_n);
    same(reading.force_zero_n, expected.force_zero_n);
    same(reading.added_friction_n, expected.added_friction_n);
    assert_eq!(reading.samples, expected.samples);
    assert_eq!((reading.rejected, expected.rejected), (1, 1));
    assert_eq!(reading.status, expected.status.bits());
    assert_eq!(
        reading.status & DASHPOT_HEALTH_INPUT_REJECTED,
        DASHPOT_HEALTH_INPUT_REJECTED
    );

    let baseline = DashpotHealthBaseline {
        flow_factor: reading.flow_factor,
        compliance_m_per_n: reading.compliance_m_per_n,
        clearance_m: reading.clearance_m,
    };
    let refused = DashpotHealthBaseline {
        clearance_m: DashpotEstimate {
            value: f32::NAN,
            sd: 0.0,
        },
        ..baseline
    };
    // SAFETY: references are valid pointers.
    unsafe {
        assert_eq!(dashpot_health_set_baseline(&mut model, &baseline), DONE);
        assert_eq!(
            dashpot_health_set_baseline(&mut model, &refused),
            DashpotError::Range
        );
        assert_eq!(dashpot_health_clear_status(&mut health), DONE);
    }
    assert_eq!(read(&model, &health).rejected, 0);
}

/// A damper with another clearance causes an alarm with the default limits, but not with wider limits.
#[test]
fn limits_decide_what_is_an_alarm() {
    let (damper, core) = core_model();
    let mut worn = damper;
    worn.set_clearance_m(1e-3).unwrap();
    let alarms = |model: &DashpotHealthModel| {
        let mut health = begun(model);
        let mut state = worn.at_rest(0.0);
        for tick in 0..20_000 {
            let t = tick as f32 * 1e-3;
            let x = 1e-3 * (9.0 * t).sin() + 0.5e-3 * (31.0 * t).sin();
            let force = worn.step(&mut state, x);
            // SAFETY: references are valid pointers.
            let done = unsafe { dashpot_health_tick(model, &mut health, x, force) };
            assert_eq!(done, DONE);
        }
        read(model, &health).status & DASHPOT_HEALTH_CLEARANCE
    };
    let mut model = made(&core);
    assert_eq!(alarms(&model), DASHPOT_HEALTH_CLEARANCE);
    let limits = core.limits();
    let mut wide = DashpotHealthLimits {
        flow_factor: limits.flow_factor,
        compliance: limits.compliance,
        clearance_m: 2e-3,
        deviations: limits.deviations,
    };
    // SAFETY: references are valid pointers; the function checks its arguments and refuses wrong ones.
    unsafe {
        assert_eq!(dashpot_health_set_limits(&mut model, &wide), DONE);
        assert_eq!(alarms(&model), 0);
        wide.clearance_m = f32::NAN;
        assert_eq!(dashpot_health_set_limits(&mut model, &wide), DONE);
        assert_eq!(alarms(&model), 0);
        let inside = (&raw const model).cast();
        assert_eq!(
            dashpot_health_set_limits(&mut model, inside),
            DashpotError::Overlap
        );
        assert_eq!(
            dashpot_health_set_limits(&mut model, null()),
            DashpotError::NullPointer
        );
        let mut zeros = DashpotHealthModel {
            opaque: [0; DASHPOT_HEALTH_MODEL_WORDS],
        };
        assert_eq!(
            dashpot_health_set_limits(&mut zeros, &wide),
            DashpotError::NoHealth
        );
    }
}

#[test]
fn wrong_calls_are_codes() {
    let (_, core) = core_model();
    let model = made(&core);
    let mut health = begun(&model);
    let image = core.to_image();
    let mut damaged = image;
    damaged[50] ^= 4;
    let zeros = DashpotHealthModel {
        opaque: [0; DASHPOT_HEALTH_MODEL_WORDS],
    };
    let mut unwritten = DashpotHealth {
        opaque: [0xa5a5_a5a5; DASHPOT_HEALTH_WORDS],
    };
    let mut storage = model;
    let mut reading = MaybeUninit::uninit();
    // SAFETY: the functions check their arguments and refuse wrong ones.
    unsafe {
        let mut init =
            |bytes: &[u8], length| dashpot_health_model_init(&mut storage, bytes.as_ptr(), length);
        assert_eq!(init(&damaged, damaged.len()), DashpotError::Checksum);
        assert_eq!(init(&image, image.len() - 1), DashpotError::Length);
        assert_eq!(
            dashpot_health_model_init(null_mut(), image.as_ptr(), image.len()),
            DashpotError::NullPointer
        );
        assert_eq!(
            dashpot_health_init(&mut health, &zeros),
            DashpotError::NoHealth
        );
        assert_eq!(
            dashpot_health_init(&mut health, null()),
            DashpotError::NullPointer
        );
        assert_eq!(
            dashpot_health_tick(&zeros, &mut health, 0.0, 0.0),
            DashpotError::NoHealth
        );
        assert_eq!(
            dashpot_health_tick(&model, &mut unwritten, 0.0, 0.0),
            DashpotError::NoHealth
        );
        assert_eq!(
            dashpot_health_tick(&model, null_mut(), 0.0, 0.0),
            DashpotError::NullPointer
        );
        assert_eq!(
            dashpot_health_read(&model, &unwritten, reading.as_mut_ptr()),
            DashpotError::NoHealth
        );
        assert_eq!(
            dashpot_health_read(&model, &health, null_mut()),
            DashpotError::NullPointer
        );
        let inside = (&raw mut health).cast();
        assert_eq!(
            dashpot_health_read(&model, &health, inside),
            DashpotError::Overlap
        );
        assert_eq!(
            dashpot_health_clear_status(&mut unwritten),
            DashpotError::NoHealth
        );
        assert_eq!(
            dashpot_health_set_baseline(&mut storage, null()),
            DashpotError::NullPointer
        );
    }
    assert_eq!(
        storage.opaque, model.opaque,
        "a refused call changes nothing"
    );
}
