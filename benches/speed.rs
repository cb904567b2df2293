//! Prints the table of speeds from what the other benches and counts measured: the last part of `cargo xtask bench`.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use dashpot::document::in_repository;
use dashpot::speed::{LINES, Measured, table};

fn main() {
    let folder = target_folder();
    let measured = Measured::read(
        &folder.join("criterion"),
        &in_repository("target/target_figures.json"),
        &folder.join("gungraun"),
    );
    println!("{}, {}\n", processor(), compiler());
    print!("{}", table(&LINES, &measured));
}

/// Folder in which cargo keeps the times and counts.
fn target_folder() -> PathBuf {
    let chosen = env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    chosen.unwrap_or_else(|| in_repository("target"))
}

/// Name of the processor; its architecture if the system gives no name.
fn processor() -> String {
    let text = std::fs::read_to_string(Path::new("/proc/cpuinfo")).unwrap_or_default();
    let name = text.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == "model name").then(|| value.trim().to_owned())
    });
    name.unwrap_or_else(|| env::consts::ARCH.to_owned())
}

/// Version of the compiler.
fn compiler() -> String {
    let output = Command::new("rustc").arg("--version").output();
    let version = output.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    version.unwrap_or_else(|error| format!("rustc: {error}"))
}
