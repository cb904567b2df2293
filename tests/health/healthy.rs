//! Without a fault, none is reported.

use std::thread;

use dashpot_core::health::{Health, HealthStatus};
use dashpot_testbench::health::Noise;

use crate::synthetic::{Fault, PRESETS, estimate, forces, model, ride, varied};

const ALARMS: HealthStatus = HealthStatus::FLOW
    .union(HealthStatus::STIFFNESS)
    .union(HealthStatus::CLEARANCE);

#[test]
fn an_hour_of_a_healthy_damper_with_noise_of_five_percent_has_no_alarm() {
    const HOUR: usize = 3_600_000;
    let watch = |preset: &str, seed: u64| {
        let parameters = varied(preset, None);
        let x = ride(seed, HOUR);
        let force = forces(&parameters, &parameters, HOUR, &x);
        let noise = Noise::from_rms(0.05, &x, &force);
        let (x, force) = noise.add_to(&x, &force, seed);
        let reading = estimate(&model(&parameters, &noise), &x, &force);
        assert_eq!(reading.status & ALARMS, HealthStatus::empty(), "{preset}");
        assert!(
            reading.samples > HOUR as u32 / 8,
            "{preset}: {}",
            reading.samples
        );
        println!("{preset}: {reading:?}");
    };
    thread::scope(|scope| {
        scope.spawn(|| {
            watch(PRESETS[0], 11);
            watch(PRESETS[1], 12);
        });
        watch(PRESETS[2], 13);
        watch(PRESETS[3], 14);
    });
}

#[test]
fn a_damper_at_rest_for_an_hour_keeps_its_estimate() {
    let parameters = varied("in-service", None);
    let faulty = Fault::Clearance.on(&parameters);
    let x = ride(21, 20_000);
    let force = forces(&faulty, &faulty, 0, &x);
    let noise = Noise::from_rms(0.02, &x, &force);
    let model = model(&parameters, &noise);
    let (noisy_x, noisy_force) = noise.add_to(&x, &force, 3);
    let mut health = Health::new(&model);
    let tick = |health: &mut Health, (x, force): (&f64, &f64)| {
        health.tick(&model, *x as f32, *force as f32);
    };
    let samples = noisy_x.iter().zip(&noisy_force);
    samples.clone().for_each(|sample| tick(&mut health, sample));
    let before = health.reading(&model);
    // The damper rests in its clearance, first without and then with an offset of the force sensor.
    for standing in [0.0, 200.0] {
        let (still_x, still_force) =
            noise.add_to(&vec![x[0]; 1_800_000], &vec![standing; 1_800_000], 4);
        let still = still_x.iter().zip(&still_force);
        still.for_each(|sample| tick(&mut health, sample));
    }
    let after = health.reading(&model);
    for (before, after) in [
        (before.flow_factor, after.flow_factor),
        (before.compliance_m_per_n, after.compliance_m_per_n),
        (before.clearance_m, after.clearance_m),
    ] {
        let change = (after.value - before.value).abs();
        assert!(
            change < 4.0 * before.sd.max(after.sd),
            "{before:?} {after:?}"
        );
    }
    // The estimate continues as if nothing had happened.
    samples.for_each(|sample| tick(&mut health, sample));
    let again = health.reading(&model);
    let clearance = f64::from(again.clearance_m.value);
    assert!((clearance - 2e-3).abs() < 0.05e-3, "{again:?}");
}

#[test]
fn little_motion_is_reported() {
    let parameters = varied("paper", None);
    let noise = Noise {
        displacement_m: 60e-6,
        force_n: 90.0,
    };
    let model = model(&parameters, &noise);
    let x: Vec<f64> = ride(31, 10_000).iter().map(|x| 1e-3 * x).collect();
    let force = forces(&parameters, &parameters, 0, &x);
    let (x, force) = noise.add_to(&x, &force, 5);
    let reading = estimate(&model, &x, &force);
    assert!(reading.status.contains(HealthStatus::LITTLE_EXCITATION));
    assert_eq!(reading.status & ALARMS, HealthStatus::empty());
    assert!(reading.flow_factor.sd > 0.25, "{reading:?}");
}
