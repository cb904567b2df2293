//! Every check there is, in the order of how soon it fails.

use crate::firmware;
use crate::processor::CORTEX_M7;
use crate::run::{Outcome, cargo, cargo_with};
use crate::rust_version;
use crate::test_run::test;
use crate::tools::{CARGO_HACK, install_missing};

/// Not of the main workspace: the C library has a C name and its own panic strategy, the firmware is built for
/// the target, fuzz targets have their own entry point.
const C_LIBRARY: &str = "capi/Cargo.toml";
const FIRMWARE: &str = "firmware/Cargo.toml";
const FUZZ: &str = "fuzz/Cargo.toml";

/// Runs every check that the stated compiler can do; Miri and fuzzing need a nightly one and are commands of their own.
///
/// # Errors
/// The first that failed.
pub fn ci() -> Outcome {
    install_missing();
    cargo(&["fmt", "--all", "--check"])?;
    for manifest in [C_LIBRARY, FIRMWARE, FUZZ] {
        cargo(&["fmt", "--manifest-path", manifest, "--check"])?;
    }
    lint(&["--workspace", "--all-targets"])?;
    lint(&["--manifest-path", C_LIBRARY, "--all-targets"])?;
    lint(&["--manifest-path", FIRMWARE, "--target", CORTEX_M7.target])?;
    lint(&["--manifest-path", FUZZ])?;
    cargo_with(
        &["doc", "--workspace", "--no-deps"],
        &[("RUSTDOCFLAGS", "-D warnings")],
    )?;
    rust_version::check()?;
    each_feature()?;
    firmware::build_default()?;
    test()
}

fn lint(what: &[&str]) -> Outcome {
    cargo(&[&["clippy"], what, &["--", "-D", "warnings"]].concat())
}

/// Every feature of every package alone, none, and all.
fn each_feature() -> Outcome {
    CARGO_HACK.install()?;
    cargo(&[
        "hack",
        "clippy",
        "--workspace",
        // Its folder is the workspace's, where cargo takes the default members; its one feature is a bench's.
        "--exclude",
        "dashpot",
        "--each-feature",
        "--",
        "-D",
        "warnings",
    ])
}
