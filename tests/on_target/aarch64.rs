//! Force bits on a 64-bit Arm processor, where a bank uses other vector instructions than on x86-64.

use std::process::Command;

use dashpot::target::experiments;
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

fn succeed(command: &mut Command) {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let printed = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{command:?}: {}\n{printed}",
        output.status
    );
}
