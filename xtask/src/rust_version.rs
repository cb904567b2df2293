//! The `rust-version` that Cargo.toml states: with that compiler everything builds.

use std::process::Command;

use crate::run::{Outcome, cargo_of, run, version_of};

/// Of this package, and of every other: they inherit it.
const STATED: &str = env!("CARGO_PKG_RUST_VERSION");

/// What is to be done about a stated version.
#[derive(Debug, PartialEq, Eq)]
enum Check {
    /// Nothing: the compiler that runs all checks is that version.
    Same,
    /// Builds with this toolchain.
    BuildWith(String),
    /// It is above the compiler that runs the checks.
    Above,
}

/// Builds everything with the stated version, where that is not the compiler of all the other checks.
///
/// # Errors
/// The build fails, rustup lacks that version and cannot install it, or the running compiler is older.
pub fn check() -> Outcome {
    let compiler = version_of("rustc", &["--version"])?;
    match needed(STATED, &compiler) {
        Check::Same => {
            println!("rust-version {STATED} is the compiler of these checks, rustc {compiler}");
            Ok(())
        }
        Check::BuildWith(toolchain) => build_with(&toolchain),
        Check::Above => Err(format!(
            "Cargo.toml states rust-version {STATED}, above rustc {compiler}"
        )),
    }
}

fn needed(stated: &str, compiler: &str) -> Check {
    let (stated_numbers, compiler) = (numbers(stated), numbers(compiler));
    if compiler.starts_with(&stated_numbers) {
        Check::Same
    } else if compiler < stated_numbers {
        Check::Above
    } else {
        let patch = if stated_numbers.len() < 3 { ".0" } else { "" };
        Check::BuildWith(format!("{stated}{patch}"))
    }
}

fn build_with(toolchain: &str) -> Outcome {
    let mut install = Command::new("rustup");
    install.args(["toolchain", "install", toolchain, "--profile", "minimal"]);
    run(install, &format!("rustup toolchain install {toolchain}"))?;
    // In a folder of its own: two compilers in one would build everything again in turns.
    let check = [
        "check",
        "--workspace",
        "--all-targets",
        "--target-dir",
        "target/rust_version",
    ];
    cargo_of(toolchain, &check, &[])
}

/// `1.95.0-nightly` as `[1, 95, 0]`.
pub fn numbers(version: &str) -> Vec<u32> {
    version
        .split(['.', '-'])
        .map_while(|part| part.parse().ok())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Check, needed, numbers};

    #[test]
    fn versions_compare_as_numbers() {
        assert!(numbers("1.95") <= numbers("1.95.0"));
        assert!(numbers("1.100.0") > numbers("1.95.0"));
        assert_eq!(numbers("1.97.0-nightly"), [1, 97, 0]);
    }

    #[test]
    fn the_stated_version_is_built_with_unless_it_runs() {
        assert_eq!(needed("1.95", "1.95.0"), Check::Same);
        assert_eq!(needed("1.95", "1.95.1"), Check::Same);
        assert_eq!(needed("1.95", "1.94.9"), Check::Above);
        assert_eq!(needed("1.95", "1.100.0"), Check::BuildWith("1.95.0".into()));
        assert_eq!(
            needed("1.95.1", "1.96.0"),
            Check::BuildWith("1.95.1".into())
        );
    }
}
