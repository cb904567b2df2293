//! Runs all checks; those that fail soonest come first.

use crate::board::board;
use crate::dependencies;
use crate::firmware;
use crate::packages::{rehearse_publishing, with_features};
use crate::processor::CORTEX_M7;
use crate::run::{Outcome, cargo, cargo_with};
use crate::rust_version;
use crate::setup::{install_for_tests, install_targets};
use crate::test_run::test;
use crate::timings;
use crate::tools::CARGO_HACK;
use crate::web;
use crate::wheel;

/// Manifests outside the main workspace: the C library has a C name and its own panic strategy, the firmware is built
/// for the target, and fuzz targets have their own entry point.
const C_LIBRARY: &str = "capi/Cargo.toml";
const FIRMWARE: &str = "firmware/Cargo.toml";
const FUZZ: &str = "fuzz/Cargo.toml";

/// Runs every check that a change may fail and a stable compiler supports. Those of [`release_checks`], and Miri and
/// fuzzing, which need a nightly compiler, have their own commands.
///
/// # Errors
/// The first check that failed.
pub fn ci() -> Outcome {
    install_for_tests();
    cargo(&["fmt", "--all", "--check"])?;
    for manifest in [C_LIBRARY, FIRMWARE, FUZZ] {
        cargo(&["fmt", "--manifest-path", manifest, "--check"])?;
    }
    timings::check_packages()?;
    dependencies::check()?;
    lint(&["--workspace", "--all-targets"])?;
    // In the folder of the workspace, they share its dependencies.
    let shared = ["--target-dir", "target"];
    lint(
        &[
            &["--manifest-path", C_LIBRARY, "--all-targets"],
            &shared[..],
        ]
        .concat(),
    )?;
    let firmware = ["--manifest-path", FIRMWARE, "--target", CORTEX_M7.target];
    lint(&[&firmware[..], &["--features", "tcp"]].concat())?;
    lint(&[&firmware[..], &firmware::NUCLEO].concat())?;
    lint(&[&["--manifest-path", FUZZ], &shared[..]].concat())?;
    cargo_with(
        &["doc", "--workspace", "--no-deps"],
        &[("RUSTDOCFLAGS", "-D warnings")],
    )?;
    rehearse_publishing()?;
    rust_version::check_core()?;
    each_feature()?;
    firmware::build_default()?;
    // No other check builds the command with optimisation, so measuring this build costs no extra time.
    timings::build_and_demonstrate()?;
    test()
}

/// Runs checks that take minutes and seldom fail: the workspace with its lowest compiler, the page's module built
/// again, the wheel, and the image for a board.
///
/// # Errors
/// The first check that failed.
pub fn release_checks() -> Outcome {
    install_targets(&[web::TARGET]);
    rust_version::check_workspace()?;
    web::check()?;
    wheel::check()?;
    board().map(drop)
}

fn lint(packages: &[&str]) -> Outcome {
    cargo(&[&["clippy"], packages, &["--", "-D", "warnings"]].concat())
}

/// Checks each package that has features without them, with each feature alone, and with all features. The package in
/// the top folder is left out: its only feature is for a bench.
fn each_feature() -> Outcome {
    CARGO_HACK.install()?;
    let packages = with_features()?;
    let mut arguments = vec!["hack", "clippy", "--each-feature"];
    arguments.extend(
        packages
            .iter()
            .flat_map(|package| ["--package", &package.name]),
    );
    arguments.extend(["--", "-D", "warnings"]);
    cargo(&arguments)
}
