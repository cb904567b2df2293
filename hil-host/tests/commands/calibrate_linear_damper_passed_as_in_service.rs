//! Regression: fitting a linear damper as `in-service` wrote a damper file with the skew at its bound, and exited with
//! code 0.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::path::Path;

use fastrand::Rng;

use crate::common::advice::advised;
use crate::common::{bench, dashpot, error_of, files_in};

/// Damping and stiffness of the linear damper.
const LINEAR: (f64, f64) = (60e3, 8e6);

/// Amplitude (m) and frequency (Hz) of its tests.
const TESTS: [(f64, f64); 3] = [(25e-3, 0.64), (5e-3, 2.0), (24.5e-3, 1.9)];

/// Writes three tests of the damper from the closed form of a Maxwell element, with noise of 1 % on both signals.
fn write(path: &Path) {
    let mut rng = Rng::with_seed(7);
    // The sum of twelve uniform numbers is nearly normal with variance 1.
    let mut noise = || (0..12).map(|_| rng.f64()).sum::<f64>() - 6.0;
    let mut rows = String::from("time_s,displacement_m,force_n\n");
    for (number, (amplitude_m, frequency_hz)) in (0..).zip(TESTS) {
        let (damping, stiffness) = LINEAR;
        let (speed, lag) = (TAU * frequency_hz, TAU * frequency_hz * damping / stiffness);
        let peak_n = damping * amplitude_m * speed / (1.0 + lag * lag).sqrt();
        for sample in 0..2000 {
            let time_s = 2e-3 * f64::from(sample);
            let angle = speed * time_s;
            let force_n = peak_n * (angle.cos() + lag * angle.sin()) / (1.0 + lag * lag).sqrt();
            let row = [
                10.0 * f64::from(number) + time_s,
                amplitude_m * (angle.sin() + 7e-3 * noise()),
                force_n + 7e-3 * peak_n * noise(),
            ];
            writeln!(rows, "{:.6},{},{}", row[0], row[1], row[2]).unwrap();
        }
    }
    std::fs::write(path, rows).unwrap();
}

#[test]
fn a_linear_damper_is_refused_with_a_start_that_explains_it() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    write(&folder.join("run.csv"));
    let vary = [
        "--vary",
        "orifice.discharge_coefficient",
        "--vary",
        "mount.stiffness_n_per_m",
    ];
    let line = bench::calibrate("in-service", &vary);
    let run = |line: &[String]| {
        let line: Vec<&str> = line.iter().map(String::as_str).collect();
        dashpot(&line, folder)
    };
    let text = error_of(&run(&line).code(1));
    assert!(
        text.contains("`reduced-vertical` explains the recordings"),
        "{text}"
    );
    assert_eq!(files_in(folder), ["run.csv"]);
    for advised in advised(&line, &text) {
        run(&advised).success();
        let found = std::fs::read_to_string(folder.join("found.toml")).unwrap();
        let found = dashpot_files::damper::parse("found", &found, &[]).unwrap();
        let found = dashpot_files::damper::KeyedParameters::new("found", &found).unwrap();
        let damping = found.number("reduced.damping_n_s_per_m").unwrap();
        assert!((damping / LINEAR.0 - 1.0).abs() < 0.03, "{damping}");
    }
}
