//! FMPy validates, simulates and compiles an FMU; the forces are those of the step.

use std::fs;
use std::path::Path;
use std::process::Command;

use xtask::python::have_packages;
use xtask::tools::{CMAKE, MAKE, have};

use crate::{Unpacked, bits, displacements_m, forces_n, source};

fn judged(python: &Path, fmu: &Unpacked, more: &[&str]) -> (String, Vec<f64>) {
    let mut judge = Command::new(python);
    judge
        .arg(source("tests/fmu/fmpy_judge.py"))
        .args(["it.fmu", "x.txt", "forces.txt"])
        .args(more);
    let output = judge.current_dir(fmu.folder.path()).output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{text}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let forces = fs::read_to_string(fmu.path("forces.txt")).unwrap();
    (
        text,
        forces.lines().map(|force| force.parse().unwrap()).collect(),
    )
}

/// Steps that do not divide a second: FMPy ends at the stop time of the description.
#[test]
fn fmpy_simulates_any_step() {
    let Some(python) = have_packages("FMUs of any step by FMPy") else {
        return;
    };
    for (fmi, step_us) in [("2", "300"), ("3", "333.3333"), ("3", "20000")] {
        let fmu = Unpacked::new(fmi, &["--step-us", step_us]);
        let mut simulate = Command::new(&python);
        simulate.args([
            "-m",
            "fmpy",
            "simulate",
            "it.fmu",
            "--output-file",
            "out.csv",
            "--timeout",
            "60",
        ]);
        let output = simulate.current_dir(fmu.folder.path()).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "FMI {fmi} {step_us} us: {text}");
        assert!(
            fs::read_to_string(fmu.path("out.csv"))
                .unwrap()
                .lines()
                .count()
                > 40
        );
    }
}

/// FMPy repeats a rejected step of an FMI 2 FMU; the second rejection is an error, and FMPy ends.
#[test]
fn fmpy_ends_when_a_step_is_refused() {
    let Some(python) = have_packages("FMUs refusing steps by FMPy") else {
        return;
    };
    for fmi in ["2", "3"] {
        let fmu = Unpacked::new(fmi, &[]);
        let mut simulate = Command::new(&python);
        simulate.args([
            "-m",
            "fmpy",
            "--debug-logging",
            "simulate",
            "it.fmu",
            "--output-interval",
            "0.0025",
        ]);
        let output = simulate.current_dir(fmu.folder.path()).output().unwrap();
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8_lossy(&text);
        assert!(!output.status.success(), "FMI {fmi}: {text}");
        assert!(
            text.contains("a communication step of 0.0025 s, allowed"),
            "{text}"
        );
        assert_eq!(text.contains("it was refused before"), fmi == "2", "{text}");
    }
}

#[test]
fn fmpy_finds_no_problem_and_the_same_forces() {
    if !have(&[CMAKE, MAKE], "FMUs compiled by FMPy") {
        return;
    }
    let Some(python) = have_packages("FMUs by FMPy") else {
        return;
    };
    let mut x = displacements_m();
    x.truncate(1000);
    let expected = forces_n("in-service", &x);
    let text: String = x.iter().map(|x| format!("{x:e}\n")).collect();
    for fmi in ["2", "3"] {
        for (more, flag) in [
            (&[][..], &[][..]),
            (&["--sources-only"][..], &["--compile"][..]),
        ] {
            let fmu = Unpacked::new(fmi, more);
            fs::write(fmu.path("x.txt"), &text).unwrap();
            let (message, forces) = judged(&python, &fmu, flag);
            // The first row is the start; a force belongs to the displacement one communication step earlier.
            assert_eq!(bits(&forces[1..]), bits(&expected), "FMI {fmi} {more:?}");
            assert!(message.contains("status 0"), "{message}");
        }
    }
}
