//! Writes data/bench/bench_made.csv: a bench test as a rig would have recorded it, of a damper whose numbers are known.
//!
//! `cargo run --release --package dashpot-hil --example make_bench > data/bench/bench_made.csv`

use std::f64::consts::TAU;

use dashpot_hil::files::damper;
use dashpot_hil::study::verification::reference_forces;
use fastrand::Rng;

/// What the damper differs in from the preset `in-service`: a calibration has to find these numbers.
const TRUTH: [&str; 4] = [
    "orifice.discharge_coefficient=0.68",
    "valves.piston_extension.preload_pa=7e5",
    "mount.stiffness_n_per_m=7.5e6",
    "mount.clearance_m=0.6e-3",
];

/// Amplitude (m) and frequency (Hz) of the tests, one after the other.
const TESTS: [(f64, f64); 4] = [(25e-3, 0.064), (25e-3, 0.64), (5e-3, 2.0), (24.5e-3, 1.9)];

/// Interval of the samples (s), and seconds between the tests.
const INTERVAL_S: f64 = 2e-3;
const PAUSE_S: f64 = 5.0;

/// Cycles of a test, and seconds at least.
const CYCLES: f64 = 3.0;
const LEAST_S: f64 = 4.0;

/// Samples by which the force is recorded later: 4 ms.
const LATE: usize = 2;

/// Noise of either signal, of its rms.
const NOISE: f64 = 0.01;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let damper = damper::load("in-service", &TRUTH.map(String::from))?;
    let mut rng = Rng::with_seed(2026);
    println!("# MADE, not measured: a bench test of the damper `in-service` with");
    println!("# {},", TRUTH.join(", "));
    println!(
        "# by the reference solver; noise of 1 % of the rms on both signals, the force 4 ms late."
    );
    println!("# Made by: cargo run --release --package dashpot-hil --example make_bench");
    println!("Time [s],Displacement [mm],Force [kN]");
    let mut start_s = 0.0;
    for (amplitude_m, frequency_hz) in TESTS {
        let duration_s = (CYCLES / frequency_hz).max(LEAST_S);
        let samples = (duration_s / INTERVAL_S) as usize;
        let x: Vec<f64> = (0..samples)
            .map(|sample| amplitude_m * (TAU * frequency_hz * sample as f64 * INTERVAL_S).sin())
            .collect();
        let forces = reference_forces(&damper, INTERVAL_S, &x)?;
        let [x_noise, force_noise] = [&x, &forces].map(|signal| {
            let square: f64 = signal.iter().map(|value| value * value).sum();
            NOISE * (square / samples as f64).sqrt()
        });
        for sample in LATE..samples {
            println!(
                "{:.3},{:.4},{:.4}",
                start_s + sample as f64 * INTERVAL_S,
                (x[sample] + x_noise * normal(&mut rng)) * 1e3,
                (forces[sample - LATE] + force_noise * normal(&mut rng)) * 1e-3
            );
        }
        start_s += duration_s + PAUSE_S;
    }
    Ok(())
}

/// A number of a normal distribution (Box and Muller).
fn normal(rng: &mut Rng) -> f64 {
    let radius = (-2.0 * (1.0 - rng.f64()).ln()).sqrt();
    radius * (TAU * rng.f64()).cos()
}
