//! Checks that need a nightly compiler: undefined behaviour under Miri, and fuzzing guided by coverage.

use std::fs;

use crate::run::{Outcome, cargo_of, cargo_of_toolchain, output_of, repository};
use crate::tools::CARGO_FUZZ;

const NIGHTLY: &str = "nightly";

/// Target with four-byte pointers, like the firmware's processors. Miri cannot run the assembly that `libm` has for
/// x86-64.
const MIRI_TARGET: &str = "armv7-unknown-linux-gnueabihf";

/// Tests that cross the C interface, except the test of its header. The core, which they call, has no unsafe code.
const MIRI_ARGUMENTS: [&str; 14] = [
    "miri",
    "test",
    "--target",
    MIRI_TARGET,
    "--manifest-path",
    "capi/Cargo.toml",
    "--test",
    "contract",
    "--test",
    "integrity",
    "--test",
    "overlap",
    "--test",
    "version",
];

/// Checks that there is a nightly toolchain with Miri.
///
/// # Errors
/// There is no such toolchain. The message contains the command that installs it.
fn find_miri() -> Outcome {
    let mut miri = cargo_of_toolchain(NIGHTLY);
    miri.args(["miri", "--version"]);
    output_of(miri, "cargo +nightly miri --version")
        .map(drop)
        .map_err(|_| "run `rustup toolchain install nightly --component miri,rust-src`".into())
}

/// Runs the tests of the C interface under Miri.
///
/// # Errors
/// There is no nightly toolchain, a test fails, or a test has undefined behaviour.
pub fn miri() -> Outcome {
    find_miri()?;
    // Miri finds more in unoptimised code.
    let variables = [("CARGO_PROFILE_DEV_OPT_LEVEL", "0")];
    cargo_of(NIGHTLY, &MIRI_ARGUMENTS, &variables)
}

/// Runs each fuzz target for this number of seconds, starting from the kept seeds and the inputs that earlier runs
/// found.
///
/// # Errors
/// There is no nightly toolchain, or a target fails. The output names the input on which it fails.
pub fn fuzz(seconds: u32) -> Outcome {
    find_miri()?;
    CARGO_FUZZ.install()?;
    let mut list = cargo_of_toolchain(NIGHTLY);
    list.args(["fuzz", "list"]);
    for target in output_of(list, "cargo +nightly fuzz list")?.lines() {
        let [corpus, seeds] = ["corpus", "seeds"].map(|folder| format!("fuzz/{folder}/{target}"));
        fs::create_dir_all(repository().join(&corpus))
            .map_err(|error| format!("{corpus}: {error}"))?;
        let time = format!("-max_total_time={seconds}");
        // The fuzzed code has no unsafe code, so a memory sanitizer would find nothing.
        let sanitizer = "--sanitizer=none";
        let arguments = [
            "fuzz", "run", sanitizer, target, &corpus, &seeds, "--", &time,
        ];
        cargo_of(NIGHTLY, &arguments, &[])?;
    }
    Ok(())
}
