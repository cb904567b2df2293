//! Checks and builds the image for the board NUCLEO-H753ZI, in its own workspace. It takes minutes of processor time
//! and packages that nothing else needs, so it has a command of its own.

use std::path::PathBuf;
use std::process::Command;

use crate::dependencies;
use crate::processor::CORTEX_M7;
use crate::run::{Outcome, repository, run};

/// Folder of the image.
pub const FOLDER: &str = "firmware/nucleo-h753zi";

/// Options of cargo for each line of the link: Ethernet and the serial port, whose image stays.
const LINES: [&[&str]; 2] = [&["--features", "ethernet"], &[]];

/// Checks format, lints and licences, builds the image for each line, and returns the path of the last one.
///
/// # Errors
/// A check or the build fails.
pub fn board() -> Outcome<PathBuf> {
    cargo(&["fmt", "--check"])?;
    let all = ["--locked", "--release"];
    for line in LINES {
        cargo(&[&["clippy"], &all[..], line, &["--", "-D", "warnings"]].concat())?;
        cargo(&[&["build"], &all[..], line].concat())?;
    }
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
