//! Bits on a 64-bit Arm processor, whose vector instructions are others than those of x86-64.

use std::path::PathBuf;
use std::process::Command;

use dashpot::document;
use dashpot::target::experiments;
use dashpot_physics::{Results, Runs, STUDY, study};
use xtask::aarch64;
use xtask::processor::AARCH64;
use xtask::tools::{AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64, have, have_library};

#[test]
fn a_64_bit_arm_has_the_hosts_forces() {
    let Some(program) = built("dashpot-experiment", "force bits on a 64-bit Arm processor") else {
        return;
    };
    for experiment in experiments(0.1) {
        let found = experiment.digest_by(&mut aarch64::program(&program));
        let (element, excitation) = (experiment.element, experiment.excitation.name());
        assert_eq!(found, experiment.digest_here(), "{element}, {excitation}");
    }
}

#[test]
fn a_64_bit_arm_has_the_hosts_contact_vehicle_and_indices() {
    let what = "contact, vehicle and indices on a 64-bit Arm processor";
    let Some(program) = built("dashpot-physics", what) else {
        return;
    };
    // The contact tables come from this machine: the emulator would take minutes. The elastic contact behind them is a
    // part of the results.
    let here = Results::new(&Runs::of(&study(
        &document::in_repository(STUDY).to_string_lossy(),
    )));
    let mut program = aarch64::program(&program);
    let found = succeed(program.arg(document::in_repository(STUDY)));
    assert_eq!(found, here.text());
}

/// Builds a program for the processor, if its tools are present. Otherwise says that `what` is not tested.
fn built(name: &str, what: &str) -> Option<PathBuf> {
    if !have_library(AARCH64, what) || !have(&[AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64], what) {
        return None;
    }
    succeed(aarch64::cargo("build").args(["--release", "--package", name]));
    Some(aarch64::release(name))
}

/// Returns what the command prints.
fn succeed(command: &mut Command) -> String {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{command:?}: {}\n{printed}",
        output.status
    );
    String::from_utf8_lossy(&output.stdout).into_owned()
}
