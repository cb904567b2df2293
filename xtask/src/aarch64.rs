//! Builds programs for the 64-bit Arm processor and runs them in QEMU's user emulation.

use std::path::PathBuf;
use std::process::Command;

use crate::processor::AARCH64;
use crate::run::repository;
use crate::tools::{AARCH64_GCC, QEMU_AARCH64};

/// Folder in which Debian's packages install the C library.
const LIBRARIES: &str = "/usr/aarch64-linux-gnu";

/// Returns `cargo <command> --target aarch64-unknown-linux-gnu`, to which the caller adds arguments. Cargo runs
/// programs in the emulator.
pub fn cargo(command: &str) -> Command {
    let mut cargo = Command::new("cargo");
    cargo
        .env(
            "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER",
            AARCH64_GCC.program,
        )
        .env(
            "CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUNNER",
            emulator().join(" "),
        )
        .env_remove("CARGO_TARGET_DIR")
        .current_dir(repository())
        .args([command, "--locked", "--target", AARCH64, "--target-dir"])
        .arg(folder());
    cargo
}

/// Returns the command that runs a program for this processor, to which the caller adds arguments.
pub fn program(path: &std::path::Path) -> Command {
    let [emulator, arguments @ ..] = emulator();
    let mut command = Command::new(emulator);
    command.args(arguments).arg(path);
    command
}

/// Returns the path of the program with this name in the release build.
pub fn release(name: &str) -> PathBuf {
    folder().join(AARCH64).join("release").join(name)
}

fn folder() -> PathBuf {
    repository().join("target/aarch64")
}

fn emulator() -> [&'static str; 3] {
    [QEMU_AARCH64.program, "-L", LIBRARIES]
}
