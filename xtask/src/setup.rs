//! Installs compiler targets, Debian packages and Python packages that tests need.

use std::process::Command;

use crate::processor::{CORTEX_M7, CORTEX_M33, TARGETS};
use crate::python;
use crate::run::Outcome;
use crate::target_toolchain::TargetToolchain;
use crate::tools::{ARM_GCC, ARM_LD, ARM_LIBC, QEMU, TEST_TOOLS, Tool, install, missing};
use crate::web;

/// Debian packages with a compiler for the Cortex-M processors, for a machine without rustup.
const TOOLCHAIN_PACKAGES: [&str; 3] = ["rustc-web", "cargo-web", "rust-web-src"];

/// Tools for the tests that measure the core on emulated processors.
const TARGET_TOOLS: [Tool; 4] = [ARM_GCC, ARM_LD, ARM_LIBC, QEMU];

/// Installs what all tests need. If that fails, prints the command to run by hand; the tests that need it are skipped.
pub fn install_for_tests() {
    let mut packages = Vec::new();
    if python::lacks_environments() {
        packages.push(python::ENVIRONMENTS);
    }
    install_targets(&TARGETS);
    install_targets(&[web::TARGET]);
    report(install_tools(&TEST_TOOLS, &packages));
    report(python::install());
}

/// Installs what the tests on emulated Cortex-M processors need, in the same way as [`install_for_tests`].
pub fn install_for_target() {
    install_targets(&[CORTEX_M7.target, CORTEX_M33.target]);
    report(install_tools(&TARGET_TOOLS, &[]));
}

fn report(outcome: Outcome) {
    if let Err(message) = outcome {
        eprintln!("\n!!!! {message}; the tests that need it will be skipped\n");
    }
}

/// Installs the missing tools, the other packages, and a compiler for the firmware's processor if there is none.
fn install_tools(tools: &[Tool], others: &[&'static str]) -> Outcome {
    let mut packages = missing(tools);
    packages.extend(others);
    if TargetToolchain::find(CORTEX_M7.target).is_err() {
        packages.extend(TOOLCHAIN_PACKAGES);
    }
    match packages[..] {
        [] => Ok(()),
        _ => install(&packages),
    }
}

/// Installs the missing libraries of targets if rustup is present.
pub fn install_targets(targets: &[&str]) {
    let lacks = |target: &&str| TargetToolchain::installed(target).is_none();
    let missing: Vec<&str> = targets.iter().copied().filter(lacks).collect();
    if missing.is_empty() || Command::new("rustup").arg("--version").output().is_err() {
        return;
    }
    let added = Command::new("rustup")
        .args(["target", "add"])
        .args(&missing)
        .status();
    if !added.is_ok_and(|status| status.success()) {
        let line = missing.join(" ");
        eprintln!("\n!!!! `rustup target add {line}` failed; their tests will be skipped\n");
    }
}
