//! Checks and builds the image for the board NUCLEO-H753ZI, in its own workspace. It takes 90 s of processor time and
//! packages that nothing else needs, so it has a command of its own.

use std::path::PathBuf;
use std::process::Command;

use crate::dependencies;
use crate::processor::CORTEX_M7;
use crate::run::{Outcome, repository, run};

/// Folder of the image.
pub const FOLDER: &str = "firmware/nucleo-h753zi";

/// Checks format, lints and licences, builds the image, and returns its path.
///
/// # Errors
/// A check or the build fails.
pub fn board() -> Outcome<PathBuf> {
    cargo(&["fmt", "--check"])?;
    cargo(&["clippy", "--locked", "--release", "--", "-D", "warnings"])?;
    cargo(&["build", "--locked", "--release"])?;
    dependencies::check_licences(FOLDER)?;
    let built = repository().join(FOLDER).join("target");
    Ok(built
        .join(CORTEX_M7.target)
        .join("release/dashpot-nucleo-h753zi"))
}

/// Runs cargo in the folder of the image, whose settings select the target.
fn cargo(arguments: &[&str]) -> Outcome {
    let mut command = Command::new("cargo");
    command
        .args(arguments)
        .current_dir(repository().join(FOLDER));
    command
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_TARGET_DIR");
    run(
        command,
        &format!("cargo {} in {FOLDER}", arguments.join(" ")),
    )
}
