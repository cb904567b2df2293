//! Builds the C library, for this machine or a processor.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::processor::Processor;
use crate::run::{Outcome, output_of, repository};
use crate::target_toolchain::TargetToolchain;

/// Folder of the C library's package.
pub fn folder() -> PathBuf {
    repository().join("capi")
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
    build(command, &folder().join("target"), "release")
}

/// Builds `libdashpot.a` for a processor; returns where it is.
///
/// # Errors
/// As [`build_for_host`].
pub fn build_for(toolchain: &TargetToolchain, processor: &Processor) -> Outcome<PathBuf> {
    let command = toolchain.cargo("rustc", &folder().join("Cargo.toml"), processor);
    let target = toolchain.output_folder(&folder(), processor);
    build(command, &target, &format!("{}/release", processor.target))
}

fn build(mut cargo: Command, target: &Path, output: &str) -> Outcome<PathBuf> {
    cargo.args([
        "--crate-type",
        "staticlib",
        "--features",
        "panic-handler",
        "--target-dir",
    ]);
    cargo.arg(target);
    let line = format!("{cargo:?}");
    output_of(cargo, &line)?;
    Ok(target.join(output).join("libdashpot.a"))
}
