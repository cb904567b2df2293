//! Any input produces finite estimates, and a copy continues exactly like the original.

use dashpot_core::health::{Health, HealthStatus};
use dashpot_testbench::health::Noise;
use fastrand::Rng;

use crate::synthetic::{Fault, PRESETS, errors, estimate, forces, model, ride, varied};

const NOISE: Noise = Noise {
    displacement_m: 60e-6,
    force_n: 90.0,
};

fn all_finite(health: &Health, model: &dashpot_core::health::HealthModel) -> bool {
    let reading = health.reading(model);
    let estimates = [
        reading.flow_factor,
        reading.stiffness_n_per_m,
        reading.clearance_m,
        reading.lag_s,
        reading.compliance_m_per_n,
    ];
    estimates
        .iter()
        .all(|estimate| estimate.value.is_finite() && estimate.sd.is_finite())
}

#[test]
fn any_bits_give_numbers_and_are_forgotten() {
    let parameters = varied("in-service", None);
    let model = model(&parameters, &NOISE);
    let x = ride(41, 20_000);
    let force = forces(&parameters, &parameters, 0, &x);
    let (x, force) = NOISE.add_to(&x, &force, 6);
    let rng = &mut Rng::with_seed(42);
    let mut health = Health::new(&model);
    for _ in 0..500_000 {
        let any = |rng: &mut Rng| f32::from_bits(rng.u32(..));
        let some = |rng: &mut Rng, most: f32| most * (2.0 * rng.f32() - 1.0);
        // The samples are random bits, or plausible but meaningless sensor values.
        let sample = match rng.u32(..4) {
            0 => (any(rng), any(rng)),
            1 => (any(rng), some(rng, 1e4)),
            2 => (some(rng, 1e-3), any(rng)),
            _ => (some(rng, 1e-3), some(rng, 1e4)),
        };
        health.tick(&model, sample.0, sample.1);
        assert!(all_finite(&health, &model), "after {sample:?}: {health:?}");
    }
    assert!(health.status().contains(HealthStatus::INPUT_REJECTED));
    for (x, force) in x.iter().zip(&force) {
        health.tick(&model, *x as f32, *force as f32);
    }
    let reading = health.reading(&model);
    assert!(
        (reading.flow_factor.value - 1.0).abs() < 0.02,
        "{reading:?}"
    );
    assert!(
        (reading.clearance_m.value - 1e-3).abs() < 0.1e-3,
        "{reading:?}"
    );
}

#[test]
fn one_bad_sample_in_a_hundred_changes_little() {
    let parameters = Fault::Clearance.on(&varied("in-service", None));
    let model = model(&parameters, &NOISE);
    let x = ride(43, 20_000);
    let force = forces(&parameters, &parameters, 0, &x);
    let (mut x, mut force) = NOISE.add_to(&x, &force, 7);
    let rng = &mut Rng::with_seed(44);
    for sample in 1..x.len() {
        match rng.u32(..400) {
            0 => x[sample] = f64::NAN,
            1 => force[sample] = f64::INFINITY,
            2 => x[sample] += 1.0,
            3 => force[sample] = -2e6,
            _ => {}
        }
    }
    let reading = estimate(&model, &x, &force);
    assert!(reading.rejected > 150 && reading.status.contains(HealthStatus::INPUT_REJECTED));
    assert!(
        (reading.flow_factor.value - 1.0).abs() < 0.03,
        "{reading:?}"
    );
    assert!(
        (reading.clearance_m.value - 2e-3).abs() < 0.15e-3,
        "{reading:?}"
    );
}

/// Resetting the zero of the displacement sensor during a run is not a fault of the damper.
#[test]
fn a_sensor_reset_raises_no_alarm() {
    let parameters = varied("paper", None);
    let model = model(&parameters, &NOISE);
    let x = ride(45, 20_000);
    let force = forces(&parameters, &parameters, 0, &x);
    let (mut x, force) = NOISE.add_to(&x, &force, 8);
    x[10_000..].iter_mut().for_each(|x| *x += 0.04);
    let reading = estimate(&model, &x, &force);
    let alarms = HealthStatus::FLOW | HealthStatus::STIFFNESS | HealthStatus::CLEARANCE;
    assert_eq!(
        reading.status & alarms,
        HealthStatus::empty(),
        "{reading:?}"
    );
    assert!(
        (reading.flow_factor.value - 1.0).abs() < 0.03,
        "{reading:?}"
    );
}

#[test]
fn a_copy_continues_bit_for_bit() {
    let parameters = varied("reduced-lateral", None);
    let model = model(&parameters, &NOISE);
    let x = ride(46, 5000);
    let force = forces(&parameters, &parameters, 0, &x);
    let mut health = Health::new(&model);
    let tick = |health: &mut Health, tick: usize| {
        health.tick(&model, x[tick] as f32, force[tick] as f32);
    };
    (0..2501).for_each(|now| tick(&mut health, now));
    let mut copy = health;
    (2501..5000).for_each(|now| tick(&mut health, now));
    (2501..5000).for_each(|now| tick(&mut copy, now));
    assert_eq!(format!("{health:?}"), format!("{copy:?}"));
}

/// The force is 1 or 2 ms late, as after a filter. The lag is estimated together with the faults, whose estimates stay
/// within their bounds.
#[test]
fn a_late_force_hides_no_fault() {
    for preset in PRESETS {
        for fault in Fault::ALL {
            for (samples, seed) in [(1, 47), (2, 48), (2, 49)] {
                let healthy = varied(preset, None);
                let faulty = fault.on(&healthy);
                let x = ride(seed, 20_000);
                let force = forces(&healthy, &faulty, 10_000, &x);
                let late: Vec<f64> = (0..force.len())
                    .map(|tick: usize| force[tick.saturating_sub(samples)])
                    .collect();
                let noise = Noise::from_rms(0.02, &x, &late);
                let (x, late) = noise.add_to(&x, &late, seed);
                let reading = estimate(&model(&healthy, &noise), &x, &late);
                let [flow, stiffness, clearance, ..] = errors(&reading, &faulty, fault);
                let lag_ms = 1e3 * reading.lag_s.value;
                println!(
                    "{preset}, {fault:?}, {samples} ms late: lag {lag_ms:.2} ms, flow {:.2} %, Ke {:.1} %, 2a {:.3} mm",
                    1e2 * flow,
                    1e2 * stiffness,
                    1e3 * clearance
                );
                assert!(flow.abs() < 0.03, "{preset}, {fault:?}: flow {flow}");
                assert!(
                    fault != Fault::Stiffness || stiffness.abs() < 0.10,
                    "{preset}: Ke {stiffness}"
                );
                assert!(
                    clearance.abs() < 0.15e-3,
                    "{preset}, {fault:?}: 2a {clearance}"
                );
            }
        }
    }
}
