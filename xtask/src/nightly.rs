//! Checks that only a nightly compiler can do: undefined behaviour under Miri, and fuzzing guided by coverage.

use std::fs;

use crate::run::{Outcome, cargo_of, cargo_of_toolchain, output_of, repository};
use crate::tools::CARGO_FUZZ;

const NIGHTLY: &str = "nightly";

/// Has pointers of four bytes as the firmware's processors, and nothing that Miri cannot read: for x86-64 `libm` has
/// assembly.
const MIRI_TARGET: &str = "armv7-unknown-linux-gnueabihf";

/// What Miri runs: all tests that cross the C interface, but that of its header. The core, which they
/// drive, has no unsafe code of its own.
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

/// Whether there is a nightly toolchain with Miri.
///
/// # Errors
/// There is none; the message has the command that installs it.
fn find() -> Outcome {
    let mut miri = cargo_of_toolchain(NIGHTLY);
    miri.args(["miri", "--version"]);
    output_of(miri, "cargo +nightly miri --version")
        .map(drop)
        .map_err(|_| "run `rustup toolchain install nightly --component miri,rust-src`".into())
}

/// Runs the tests of the C interface under Miri.
///
/// # Errors
/// There is no nightly toolchain, a test failed, or its behaviour is undefined.
pub fn miri() -> Outcome {
    find()?;
    // It reads unoptimised code.
    let variables = [("CARGO_PROFILE_DEV_OPT_LEVEL", "0")];
    cargo_of(NIGHTLY, &MIRI_ARGUMENTS, &variables)
}

/// Runs each fuzz target for some seconds from the kept seeds and from what earlier runs found.
///
/// # Errors
/// There is no nightly toolchain, or a target fails on an input, which is named.
pub fn fuzz(seconds: u32) -> Outcome {
    find()?;
    CARGO_FUZZ.install()?;
    let mut list = cargo_of_toolchain(NIGHTLY);
    list.args(["fuzz", "list"]);
    for target in output_of(list, "cargo +nightly fuzz list")?.lines() {
        let [corpus, seeds] = ["corpus", "seeds"].map(|folder| format!("fuzz/{folder}/{target}"));
        fs::create_dir_all(repository().join(&corpus))
            .map_err(|error| format!("{corpus}: {error}"))?;
        let time = format!("-max_total_time={seconds}");
        // What the targets drive has no unsafe code, so there is nothing for a sanitizer of memory to find.
        let sanitizer = "--sanitizer=none";
        let arguments = [
            "fuzz", "run", sanitizer, target, &corpus, &seeds, "--", &time,
        ];
        cargo_of(NIGHTLY, &arguments, &[])?;
    }
    Ok(())
}
