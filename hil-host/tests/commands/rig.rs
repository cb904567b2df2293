//! The bench test against closed forms, and `dashpot rig` as a command.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use assert_cmd::assert::Assert;
use dashpot_files::damper;
use dashpot_files::harmonic::Harmonic;
use dashpot_reference::damper::Reference;
use dashpot_testbench::bench_test::run_until_periodic;

use crate::common::{dashpot, json_of, text_of};

fn rig(arguments: &[&str]) -> Assert {
    dashpot(&[&["rig"], arguments].concat(), Path::new("."))
}

/// A linear damper C behind a spring K (Maxwell): `C' = C/(1 + (w tau)^2)`, `E = pi w C' A^2`,
/// `F = w C A/sqrt(1 + (w tau)^2)`, tau = C/K.
#[test]
fn the_reduced_damper_without_clearance_is_a_maxwell_element() {
    let (c, k) = (120e3, 8e6);
    let overrides = [
        "mount.clearance_m=0.0",
        "reduced.saturation_velocity_m_per_s=1.0",
    ];
    let damper = damper::load("reduced-vertical", &overrides.map(str::to_owned)).unwrap();
    for (amplitude_m, frequency_hz) in [(5e-3, 0.2), (2e-3, 1.0), (0.5e-3, 10.0)] {
        let motion = Harmonic {
            amplitude_m,
            frequency_hz,
        };
        let found = run_until_periodic(&damper, motion, 1e-4).unwrap().indices();
        let w = TAU * frequency_hz;
        let ratio = 1.0 + (w * c / k).powi(2);
        let energy = PI * w * c / ratio * amplitude_m * amplitude_m;
        let force = w * c * amplitude_m / ratio.sqrt();
        // At 10 Hz, a step of 0.1 ms turns the phase by 6e-3 rad; a second-order method leaves an error of about its
        // square.
        for (value, expected) in [
            (found.energy_per_cycle_j, energy),
            (found.max_extension_force_n, force),
            (found.max_compression_force_n, force),
            (found.damping_coefficient_n_s_per_m, c / ratio.sqrt()),
        ] {
            let error = (value / expected - 1.0).abs();
            assert!(
                error < 2e-5,
                "{frequency_hz} Hz: {value} {expected} {error:e}"
            );
        }
        assert!(found.asymmetry_rate.unwrap().abs() < 1e-6);
    }
}

/// Motion within the clearance gives no force and no energy.
#[test]
fn within_the_clearance_there_is_no_force() {
    let damper = damper::load("reduced-vertical", &[]).unwrap();
    let motion = Harmonic {
        amplitude_m: 0.4e-3,
        frequency_hz: 1.0,
    };
    let found = run_until_periodic(&damper, motion, 1e-4).unwrap().indices();
    assert_eq!(found.max_extension_force_n, 0.0);
    assert_eq!(found.max_compression_force_n, 0.0);
    assert_eq!(found.energy_per_cycle_j, 0.0);
    assert_eq!(found.asymmetry_rate, None);
}

/// Compares peaks and energy of the third cycle with the reference solver, with linear motion between samples 1 ms
/// apart, which differs from a sine by (w dt)^2/8 = 2e-6. The static check values of the published equations, 11 824 N
/// and 16 638 N at 0.1 m/s, are upper bounds: behind the spring, the force peaks after the maximum velocity.
#[test]
fn the_published_damper_agrees_with_the_reference() {
    let output = rig(&["--damper", "paper", "--format", "json"]).success();
    let report = json_of(&output);
    let value = |key: &str| report[key].as_f64().unwrap();
    let (extension, compression) = (
        value("max_extension_force_n"),
        value("max_compression_force_n"),
    );
    let times: Vec<f64> = (0..4688).map(|i| f64::from(i) * 1e-3).collect();
    let x: Vec<f64> = times
        .iter()
        .map(|t| 24.875e-3 * (TAU * 0.64 * t).sin())
        .collect();
    let damper = damper::load("paper", &[]).unwrap();
    let forces = Reference::new(&damper).unwrap().forces(&times, &x).unwrap();
    let settled = &forces[3125..];
    let peak = |sign: f64| settled.iter().fold(0.0, |m: f64, f| m.max(sign * f));
    let energy: f64 = (3125..4687)
        .map(|i| 0.5 * (forces[i] + forces[i + 1]) * (x[i + 1] - x[i]))
        .sum();
    for (found, expected) in [(extension, peak(1.0)), (compression, peak(-1.0))] {
        assert!((found / expected - 1.0).abs() < 2e-5, "{found} {expected}");
    }
    // The third cycle ends half a sample after the last sample: 3e-4 of the cycle is missing, where the motion is
    // fastest.
    let found = value("energy_per_cycle_j");
    assert!((found / energy - 1.0).abs() < 1e-3, "{found} {energy}");
    let faster = TAU * 0.64 * 24.875e-3 / 0.1;
    assert!(extension < 11_824.0 * faster.powf(1.5) && extension > 0.99 * 11_824.0);
    assert!(compression < 16_638.0 * faster.powf(1.5) && compression > 0.99 * 16_638.0);
    let asymmetry = (extension - compression) / (extension + compression);
    assert!((value("asymmetry_rate") - asymmetry).abs() < 1e-12);
    let peak = TAU * 0.64 * 24.875e-3;
    let coefficient = 0.5 * (extension + compression) / peak;
    assert!((value("damping_coefficient_n_s_per_m") / coefficient - 1.0).abs() < 1e-12);
    // A progressive force between v and v^1.5 gives less than pi F A and more than 0.9 of it.
    let fraction = value("energy_per_cycle_j") / (PI * 0.5 * (extension + compression) * 24.875e-3);
    assert!((0.9..1.0).contains(&fraction), "{fraction}");
}

#[test]
fn text_compares_with_the_paper_for_its_motion_only() {
    let text = text_of(&rig(&[]));
    assert!(
        text.contains("paper simulation") && text.contains("12892"),
        "{text}"
    );
    let text = text_of(&rig(&["--frequency-hz", "1"]));
    assert!(
        !text.contains("paper simulation") && text.contains("energy per cycle"),
        "{text}"
    );
}
