//! Builds the firmware's images.

use std::path::PathBuf;

use crate::processor::{CORTEX_M7, Processor};
use crate::run::{Outcome, repository};
use crate::target_toolchain::TargetToolchain;
use crate::tools::ARM_LD;

/// Builds every image for a processor and returns the folder of the images.
///
/// # Errors
/// The build fails.
pub fn build(toolchain: &TargetToolchain, processor: &Processor) -> Outcome<PathBuf> {
    let firmware = repository().join("firmware");
    let target = toolchain.output_folder(&firmware, processor);
    let mut command = toolchain.cargo("build", &firmware.join("Cargo.toml"), processor);
    command.arg("--locked").arg("--target-dir").arg(&target);
    if matches!(toolchain, TargetToolchain::FromSource { .. }) {
        // A distribution's compiler does not come with a linker for the target.
        let variable = processor.target.to_uppercase().replace(['-', '.'], "_");
        command.env(format!("CARGO_TARGET_{variable}_LINKER"), ARM_LD.program);
    }
    let status = command
        .status()
        .map_err(|error| format!("cannot run the build of the firmware: {error}"))?;
    if status.success() {
        Ok(target.join(processor.target).join("release"))
    } else {
        Err(format!(
            "the build of the firmware for {} failed: {status}",
            processor.name
        ))
    }
}

/// Builds the firmware's images for its own processor.
///
/// # Errors
/// The build fails, or no compiler supports the target.
pub fn build_default() -> Outcome<PathBuf> {
    build(&TargetToolchain::find(CORTEX_M7.target)?, &CORTEX_M7)
}
