//! Builds the C library, for this machine or the target.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, output_of};
use crate::target_toolchain::{TARGET, TargetToolchain};

/// Folder of the C library's package.
pub fn folder() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).join("capi")
}

/// Builds `libdashpot.a` for this machine; returns where it is.
///
/// # Errors
/// It does not build; the message has what cargo said.
pub fn build_for_host() -> Outcome<PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command
        .args(["rustc", "--release", "--manifest-path"])
        .arg(folder().join("Cargo.toml"));
    build(command, "release")
}

/// Builds `libdashpot.a` for the target; returns where it is.
///
/// # Errors
/// As [`build_for_host`].
pub fn build_for_target(toolchain: &TargetToolchain) -> Outcome<PathBuf> {
    let command = toolchain.cargo("rustc", &folder().join("Cargo.toml"), "release");
    build(command, &format!("{TARGET}/release"))
}

fn build(mut cargo: Command, output: &str) -> Outcome<PathBuf> {
    let target = folder().join("target");
    cargo.args([
        "--crate-type",
        "staticlib",
        "--features",
        "panic-handler",
        "--target-dir",
    ]);
    cargo.arg(&target);
    let line = format!("{cargo:?}");
    output_of(cargo, &line)?;
    Ok(target.join(output).join("libdashpot.a"))
}
