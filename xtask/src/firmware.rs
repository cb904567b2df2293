//! Builds the firmware's images.

use std::path::{Path, PathBuf};

use crate::processor::{CORTEX_M7, Processor};
use crate::run::{Outcome, repository};
use crate::target_toolchain::TargetToolchain;
use crate::tools::ARM_LD;

/// Options of cargo that select the board NUCLEO-H753ZI.
pub const NUCLEO: [&str; 3] = ["--no-default-features", "--features", "nucleo-h753zi"];

/// Builds every image for a processor and returns the folder of the images.
///
/// # Errors
/// The build fails.
pub fn build(toolchain: &TargetToolchain, processor: &Processor) -> Outcome<PathBuf> {
    let images = toolchain.output_folder(&folder(), processor);
    let features: &[&str] = if *toolchain == TargetToolchain::Installed && *processor == CORTEX_M7 {
        // The network stack needs a newer compiler than a distribution has, and its cost is measured on one processor.
        &["--features", "tcp"]
    } else {
        &[]
    };
    build_into(&images, toolchain, processor, features)
}

/// Builds the images without measurements for the board NUCLEO-H753ZI, and returns their folder.
///
/// # Errors
/// The build fails.
pub fn build_for_nucleo(toolchain: &TargetToolchain) -> Outcome<PathBuf> {
    let images = toolchain
        .output_folder(&folder(), &CORTEX_M7)
        .join("nucleo-h753zi");
    build_into(&images, toolchain, &CORTEX_M7, &NUCLEO)
}

fn folder() -> PathBuf {
    repository().join("firmware")
}

fn build_into(
    images: &Path,
    toolchain: &TargetToolchain,
    processor: &Processor,
    features: &[&str],
) -> Outcome<PathBuf> {
    let mut command = toolchain.cargo("build", &folder().join("Cargo.toml"), processor);
    command.args(features);
    command.arg("--locked").arg("--target-dir").arg(images);
    // Boards have images of the same names, but share what the images are built from.
    let shared = toolchain.output_folder(&folder(), processor);
    command.env("CARGO_BUILD_BUILD_DIR", shared);
    if matches!(toolchain, TargetToolchain::FromSource { .. }) {
        // A distribution's compiler does not come with a linker for the target.
        let variable = processor.target.to_uppercase().replace(['-', '.'], "_");
        command.env(format!("CARGO_TARGET_{variable}_LINKER"), ARM_LD.program);
    }
    let status = command
        .status()
        .map_err(|error| format!("cannot run the build of the firmware: {error}"))?;
    if status.success() {
        Ok(images.join(processor.target).join("release"))
    } else {
        Err(format!(
            "the build of the firmware for {} failed: {status}",
            processor.name
        ))
    }
}

/// Builds the firmware's images for its own processor, on the emulator's board and on the NUCLEO-H753ZI, and returns
/// both folders.
///
/// # Errors
/// The build fails, or no compiler supports the target.
pub fn build_default() -> Outcome<[PathBuf; 2]> {
    let toolchain = TargetToolchain::find(CORTEX_M7.target)?;
    Ok([
        build(&toolchain, &CORTEX_M7)?,
        build_for_nucleo(&toolchain)?,
    ])
}
