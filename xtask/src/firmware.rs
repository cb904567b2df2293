//! Builds the firmware's images.

use std::path::{Path, PathBuf};

use crate::run::Outcome;
use crate::target_toolchain::{TARGET, TargetToolchain};

/// A distribution's compiler comes without a linker for the target.
const LINKER: (&str, &str) = (
    "CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER",
    "arm-none-eabi-ld",
);

/// Builds every image; the folder they are in.
///
/// # Errors
/// The build fails.
pub fn build(toolchain: &TargetToolchain) -> Outcome<PathBuf> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .ok_or("xtask has no folder above it")?;
    let firmware = repository.join("firmware");
    let mut command = toolchain.cargo("build", &firmware.join("Cargo.toml"), "release");
    command.arg("--locked").env_remove("CARGO_TARGET_DIR");
    if matches!(toolchain, TargetToolchain::FromSource { .. }) {
        command.env(LINKER.0, LINKER.1);
    }
    let status = command
        .status()
        .map_err(|error| format!("cannot run the build of the firmware: {error}"))?;
    if status.success() {
        Ok(firmware.join("target").join(TARGET).join("release"))
    } else {
        Err(format!("the build of the firmware failed: {status}"))
    }
}
