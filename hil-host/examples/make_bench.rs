//! Writes data/bench/bench_made.mf4, a bench test of a damper with known parameters as a rig would have recorded it,
//! and data/bench/worn_made.mf4, a ride during which the same damper wears.
//!
//! `cargo run --release --package dashpot-hil --example make_bench`

use std::error::Error;
use std::f64::consts::TAU;
use std::path::Path;

use dashpot_files::FileError;
use dashpot_files::damper;
use dashpot_files::output::write_whole;
use dashpot_recording::writer::{Column, FileFormat, RowWriter};
use dashpot_testbench::excitation::Excitation;
use dashpot_testbench::health::Noise;
use dashpot_testbench::verification::reference_forces;

/// Parameters in which the damper differs from the preset `in-service`; a calibration has to find them.
const TRUTH: [&str; 4] = [
    "orifice.discharge_coefficient=0.68",
    "valves.piston_extension.preload_pa=7e5",
    "mount.stiffness_n_per_m=7.5e6",
    "mount.clearance_m=0.6e-3",
];

/// Change of the worn damper: 1 mm more clearance.
const WORN: &str = "mount.clearance_m=1.6e-3";

/// Amplitude (m), frequency (Hz) and duration (s) of consecutive tests.
const TESTS: [(f64, f64, f64); 4] = [
    (12.5e-3, 0.2, 12.0),
    (25e-3, 0.64, 5.0),
    (5e-3, 2.0, 4.0),
    (24.5e-3, 1.9, 4.0),
];

/// Pause between two tests, s.
const PAUSE_S: f64 = 5.0;

/// Sampling interval (s); the force is recorded one sample late.
const INTERVAL_S: f64 = 2e-3;

/// Noise of both signals, relative to their rms.
const NOISE: f64 = 0.01;

const COLUMNS: [Column; 3] = [
    Column::new("time_s", "s"),
    Column::new("displacement_m", "m"),
    Column::new("force_n", "N"),
];

/// Time (s), displacement (m) and force (N).
type Rows = Vec<[f64; 3]>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut bench = Rows::new();
    let mut start_s = 0.0;
    for (number, (amplitude_m, frequency_hz, duration_s)) in (0..).zip(TESTS) {
        let samples = (duration_s / INTERVAL_S) as usize;
        let x: Vec<f64> = (0..samples)
            .map(|sample| amplitude_m * (TAU * frequency_hz * sample as f64 * INTERVAL_S).sin())
            .collect();
        bench.extend(recorded(start_s, &x, &[], number)?);
        start_s += duration_s + PAUSE_S;
    }
    write(Path::new("data/bench/bench_made.mf4"), &bench)?;
    // Ten seconds healthy, then ten seconds worn; both start at rest.
    let x = Excitation::Ride.displacements_m(INTERVAL_S);
    let mut back: Vec<f64> = x.iter().rev().copied().collect();
    back.dedup();
    let there_and_back = [x, back].concat();
    let mut ride = recorded(0.0, &there_and_back, &[], 8)?;
    let start_s = there_and_back.len() as f64 * INTERVAL_S;
    ride.extend(recorded(start_s, &there_and_back, &[WORN], 9)?);
    write(Path::new("data/bench/worn_made.mf4"), &ride)
}

/// Simulates the damper with `changes` on the displacements `x` (m) from `start_s` (s) on, with noise of this seed.
fn recorded(start_s: f64, x: &[f64], changes: &[&str], seed: u64) -> Result<Rows, Box<dyn Error>> {
    let set = TRUTH.iter().chain(changes).map(|set| (*set).to_owned());
    let damper = damper::load("in-service", &set.collect::<Vec<_>>())?;
    let forces = reference_forces(&damper, INTERVAL_S, x)?;
    let (x, forces) = Noise::from_rms(NOISE, x, &forces).add_to(x, &forces, seed);
    let late = x.iter().skip(1).zip(&forces);
    let rows = late.zip(1..).map(|((x, force), sample)| {
        let time_s = start_s + f64::from(sample) * INTERVAL_S;
        [(time_s * 1e6).round() * 1e-6, *x, *force]
    });
    Ok(rows.collect())
}

fn write(path: &Path, rows: &Rows) -> Result<(), Box<dyn Error>> {
    write_whole::<_, FileError>(path, |file| {
        let mut written = RowWriter::new(path, file, FileFormat::Mdf4, &COLUMNS)?;
        for row in rows {
            written.row(row, row)?;
        }
        written.finish()
    })?;
    println!("{}: {} rows", path.display(), rows.len());
    Ok(())
}
