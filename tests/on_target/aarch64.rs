//! Bits on a 64-bit Arm processor, which has other vector instructions than x86-64: forces of dampers and banks, and every
//! index of a vehicle.

use std::process::Command;

use dashpot::document::in_repository;
use dashpot::target::experiments;
use dashpot_study::sweep::PHYSICS;
use xtask::aarch64;
use xtask::processor::AARCH64;
use xtask::tools::{AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64, have, have_library};

#[test]
fn a_64_bit_arm_has_the_hosts_bits() {
    let what = "force bits on a 64-bit Arm processor";
    if !have_library(AARCH64, what) || !have(&[AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64], what) {
        return;
    }
    succeed(aarch64::cargo("build").args(["--release", "--package", "dashpot-experiment"]));
    let program = aarch64::release("dashpot-experiment");
    for experiment in experiments(0.1) {
        let found = experiment.digest_by(&mut aarch64::program(&program));
        let (element, excitation) = (experiment.element, experiment.excitation.name());
        assert_eq!(found, experiment.digest_here(), "{element}, {excitation}");
    }
}

#[test]
fn a_64_bit_arm_has_the_digest_of_physics() {
    let what = "indices of a vehicle on a 64-bit Arm processor";
    if !have_library(AARCH64, what) || !have(&[AARCH64_GCC, AARCH64_LIBC, QEMU_AARCH64], what) {
        return;
    }
    succeed(aarch64::cargo("build").args(["--release", "--package", "dashpot-physics"]));
    // An empty folder for the contact tables, so that they are computed there too.
    let folder = tempfile::tempdir().unwrap();
    let mut program = aarch64::program(&aarch64::release("dashpot-physics"));
    let study = in_repository(dashpot_physics::STUDY);
    let found = succeed(program.arg(study).env("XDG_CACHE_HOME", folder.path()));
    assert_eq!(found.trim(), PHYSICS);
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
