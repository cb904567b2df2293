//! FMPy validates, simulates and compiles an FMU; its forces are the step's.

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
            let (told, forces) = judged(&python, &fmu, flag);
            // Its first row is the start; a force is that of the displacement before: one communication step late.
            assert_eq!(bits(&forces[1..]), bits(&expected), "FMI {fmi} {more:?}");
            assert!(told.contains("status 0"), "{told}");
        }
    }
}
