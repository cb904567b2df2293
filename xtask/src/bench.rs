//! Measures speed and prints the table of it.

use crate::run::{Outcome, cargo, cargo_output_to_stderr, repository, version_of};
use crate::rust_version::numbers;
use crate::setup::install_for_target;

/// Version of `gungraun` in Cargo.toml; its runner must have the same version.
const GUNGRAUN: &str = "0.20";

/// Benches of each package whose times are in the table.
const BENCHES: [(&str, &[&str]); 2] = [
    ("dashpot", &["step", "vehicle", "figures"]),
    ("dashpot-hil", &["replay"]),
];

/// Measures all times side by side, the instructions on emulated processors, and, if Valgrind and gungraun-runner are
/// present, the instructions on this machine. Then prints one table: ours, the yardstick, their ratio and the goal.
///
/// # Errors
/// A bench failed.
pub fn bench() -> Outcome {
    for (package, benches) in BENCHES {
        let mut arguments = vec!["bench", "--package", package];
        arguments.extend(benches.iter().flat_map(|bench| ["--bench", bench]));
        cargo(&arguments)?;
    }
    let (_, on_target) = measure_target();
    let counted = count_instructions();
    cargo(&["bench", "--package", "dashpot", "--bench", "speed"])?;
    for lack in [on_target.err(), counted.err()].into_iter().flatten() {
        println!("not measured: {lack}");
    }
    Ok(())
}

/// Runs the test that measures the core on emulated processors against its budget. Returns its report in JSON, empty if
/// nothing could be measured, and whether the figures are within their limits.
pub fn measure_target() -> (String, Outcome) {
    install_for_target();
    let path = repository().join("target/target_figures.json");
    let _ = std::fs::remove_file(&path);
    let checked = cargo_output_to_stderr(
        &[
            "test",
            "--package",
            "dashpot",
            "--test",
            "on_target",
            "processors",
        ],
        &[("DASHPOT_TARGET_REPORT", &path.to_string_lossy())],
    );
    let report = std::fs::read_to_string(&path).unwrap_or_default();
    if report.is_empty() {
        let lack = Err("no emulated processor; the lines above name what is missing".into());
        return (report, checked.and(lack));
    }
    (report, checked)
}

/// Counts instructions on this machine.
///
/// # Errors
/// A tool is missing.
pub fn count_instructions() -> Outcome {
    version_of("valgrind", &["--version"])
        .map_err(|error| format!("{error}; install Valgrind, e.g. apt-get install valgrind"))?;
    let install = format!("cargo install gungraun-runner --version '^{GUNGRAUN}'");
    let runner = version_of("gungraun-runner", &["--version"])
        .map_err(|error| format!("{error}; {install}"))?;
    if !numbers(&runner).starts_with(&numbers(GUNGRAUN)) {
        return Err(format!(
            "gungraun-runner is {runner}, the bench needs {GUNGRAUN}: {install}"
        ));
    }
    cargo(&[
        "bench",
        "--package",
        "dashpot",
        "--features",
        "gungraun",
        "--bench",
        "instructions",
    ])
}
