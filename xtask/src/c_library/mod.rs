//! Builds and installs the C library.

mod install;
mod options;
mod platform;

use std::path::{Path, PathBuf};
use std::process::Command;

pub use install::{install, install_from};
pub use options::Options;
pub use platform::Platform;

use crate::processor::Processor;
use crate::run::{Outcome, output_of, repository};
use crate::target_toolchain::TargetToolchain;

/// Major and minor version of the interface; other versions may be incompatible.
pub const INTERFACE: &str = concat!(
    env!("CARGO_PKG_VERSION_MAJOR"),
    ".",
    env!("CARGO_PKG_VERSION_MINOR")
);

/// Returns the folder of the C library's package.
pub fn folder() -> PathBuf {
    repository().join("capi")
}

/// Builds `libdashpot.a` for a processor and returns its path.
///
/// # Errors
/// The build fails. The message contains cargo's output.
pub fn build_for(toolchain: &TargetToolchain, processor: &Processor) -> Outcome<PathBuf> {
    build_from(&manifest(), toolchain, processor)
}

/// Builds `libdashpot.a` from a manifest.
fn build_from(
    manifest: &Path,
    toolchain: &TargetToolchain,
    processor: &Processor,
) -> Outcome<PathBuf> {
    let mut cargo = toolchain.cargo("rustc", manifest, processor);
    let target = toolchain.output_folder(&folder(), processor);
    cargo.arg("--target-dir").arg(&target);
    build(cargo, "staticlib", &[])?;
    Ok(archive_in(&target.join(processor.target).join("release")))
}

/// Returns the path of the library's manifest.
pub fn manifest() -> PathBuf {
    folder().join("Cargo.toml")
}

fn archive_in(release: &Path) -> PathBuf {
    release.join("libdashpot.a")
}

/// Runs `cargo rustc` with additional arguments for the linker of the shared library.
fn build(mut cargo: Command, crate_types: &str, link_arguments: &[String]) -> Outcome {
    cargo.args(["--crate-type", crate_types, "--features", "panic-handler"]);
    cargo.arg("--");
    for argument in link_arguments {
        cargo.arg(format!("-Clink-arg={argument}"));
    }
    let line = format!("{cargo:?}");
    output_of(cargo, &line).map(drop)
}
