//! The synthetic bench test of `data/bench`, and variants as other rigs would have recorded it.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use dashpot_recording::{Channels, MeasuredSample, Measurement};

/// The path of the recording.
pub fn path() -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../data/bench/bench_made.mf4");
    path.to_str().unwrap().into()
}

/// Values chosen in examples/make_bench.rs, with the tolerance of a calibration for each.
pub const TRUTH: [(&str, f64, f64); 4] = [
    ("orifice.discharge_coefficient", 0.68, 0.01 * 0.68),
    ("mount.stiffness_n_per_m", 7.5e6, 0.03 * 7.5e6),
    ("mount.clearance_m", 0.6e-3, 0.05e-3),
    ("valves.piston_extension.preload_pa", 7e5, 0.05 * 7e5),
];

/// Writes the recording without its slow first test as CSV at `path`, each sample changed by `change`. The other tests
/// determine the same parameters in less time.
pub fn write(path: &Path, change: impl Fn(MeasuredSample) -> MeasuredSample) {
    write_from(14.0, path, change);
}

/// Writes the recording from `start_s` on as CSV at `path`, each sample changed by `change`.
pub fn write_from(start_s: f64, path: &Path, change: impl Fn(MeasuredSample) -> MeasuredSample) {
    let mut rows = String::from("time_s,displacement_m,force_n\n");
    let mut recording = Measurement::open(Path::new(&self::path()), &Channels::default()).unwrap();
    while let Some(sample) = recording.next_sample().unwrap() {
        if sample.time_s < start_s {
            continue;
        }
        let MeasuredSample {
            time_s,
            displacement_m,
            force_n,
        } = change(sample);
        writeln!(rows, "{time_s},{displacement_m},{force_n}").unwrap();
    }
    std::fs::write(path, rows).unwrap();
}

/// Runs a calibration of `damper` from `run.csv` with `more` options; writes `found.toml`.
pub fn calibrate(damper: &str, more: &[&str]) -> Vec<String> {
    let line = [
        "calibrate",
        "--damper",
        damper,
        "--input",
        "run.csv",
        "--output",
        "found.toml",
        "--starts",
        "2",
    ];
    [&line[..], more]
        .concat()
        .into_iter()
        .map(str::to_owned)
        .collect()
}

/// Options that vary the parameters in which the recorded damper differs from `in-service`.
pub const VARY: [&str; 8] = [
    "--vary", TRUTH[0].0, "--vary", TRUTH[1].0, "--vary", TRUTH[2].0, "--vary", TRUTH[3].0,
];
