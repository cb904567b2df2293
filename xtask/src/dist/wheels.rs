//! Wheels of the Python package for several platforms, and its source.

use std::path::Path;

use super::command::{BUILDS, with_zig};
use super::platform::Platform;
use crate::python::cross_builder;
use crate::run::{Outcome, repository, run};

/// Oldest Linux on which the wheels run: that of numpy's wheels for Python 3.11.
const COMPATIBILITY: &str = "manylinux2014";

/// Builds the wheel of a platform into `output`; nothing if the platform has none.
///
/// # Errors
/// It does not build.
pub fn wheel(platform: &Platform, output: &Path, time: &str) -> Outcome {
    let Some(target) = platform.python else {
        return Ok(());
    };
    let mut maturin = with_zig(cross_builder()?)?;
    maturin
        .args(["-m", "maturin", "build", "--zig", "--release", "--locked"])
        .args(["--compatibility", COMPATIBILITY, "--target", target])
        .args(["--manifest-path", "python/Cargo.toml", "--target-dir"])
        .arg(repository().join(BUILDS))
        .arg("--out")
        .arg(output)
        .env("SOURCE_DATE_EPOCH", time);
    run(maturin, &format!("maturin build for {target}"))
}

/// Packs the sources of the Python package and of the crates that it needs into `output`.
///
/// # Errors
/// maturin fails.
pub fn sources(output: &Path, time: &str) -> Outcome {
    let mut maturin = with_zig(cross_builder()?)?;
    maturin
        .args([
            "-m",
            "maturin",
            "sdist",
            "--manifest-path",
            "python/Cargo.toml",
        ])
        .arg("--out")
        .arg(output)
        .env("SOURCE_DATE_EPOCH", time);
    run(maturin, "maturin sdist")
}
