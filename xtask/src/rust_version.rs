//! Checks that the lowest compiler that each package's `rust-version` promises compiles it.

use std::process::Command;

use crate::run::{Outcome, cargo_of, run, version_of};

/// A promise of a `rust-version`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Promise {
    /// Lowest version of the compiler.
    pub version: &'static str,
    /// Arguments of `cargo check` that select the code.
    pub code: &'static [&'static str],
    /// Target; `None` for the machine's own.
    pub target: Option<&'static str>,
}

/// `rust-version` of the core, for firmware that contains only the step and the host link. The feature `builder` and
/// SIMD on a desktop need nalgebra and `wide`, whose `rust-version` is that of the workspace.
pub const CORE: &str = "1.88";

/// `rust-version` of the workspace: the highest among its dependencies.
pub const WORKSPACE: &str = env!("CARGO_PKG_RUST_VERSION");

const OF_CORE: Promise = Promise {
    version: CORE,
    code: &[
        "--package",
        "dashpot-core",
        "--no-default-features",
        "--features",
        "link,log",
    ],
    target: Some("thumbv7em-none-eabihf"),
};

const OF_WORKSPACE: Promise = Promise {
    version: WORKSPACE,
    code: &["--workspace"],
    target: None,
};

/// The check of a promised version.
#[derive(Debug, PartialEq, Eq)]
enum Check {
    /// Nothing, because all other checks already run with this version.
    Same,
    /// Compile with this toolchain.
    CompileWith(String),
    /// Fail, because the version is above that of the compiler that runs the checks.
    Above,
}

/// Compiles the core with the lowest compiler version that it promises.
///
/// # Errors
/// Code does not compile, rustup cannot install the version, or the running compiler is older than it.
pub fn check_core() -> Outcome {
    check(OF_CORE)
}

/// Compiles the workspace with the lowest compiler version that it promises. Clippy's lint `incompatible_msrv` finds
/// newer functions of the standard library sooner, but not newer syntax.
///
/// # Errors
/// As [`check_core`].
pub fn check_workspace() -> Outcome {
    check(OF_WORKSPACE)
}

fn check(promise: Promise) -> Outcome {
    let compiler = version_of("rustc", &["--version"])?;
    match needed(promise.version, &compiler) {
        Check::Same => {
            println!(
                "rust-version {} is checked by all other commands, which use rustc {compiler}",
                promise.version
            );
            Ok(())
        }
        Check::CompileWith(toolchain) => compile(&toolchain, promise),
        Check::Above => Err(format!(
            "rust-version {} is above rustc {compiler}",
            promise.version
        )),
    }
}

fn needed(promised: &str, compiler: &str) -> Check {
    let (promised_numbers, compiler) = (numbers(promised), numbers(compiler));
    if compiler.starts_with(&promised_numbers) {
        Check::Same
    } else if compiler < promised_numbers {
        Check::Above
    } else {
        let patch = if promised_numbers.len() < 3 { ".0" } else { "" };
        Check::CompileWith(format!("{promised}{patch}"))
    }
}

/// Installs the toolchain if it is missing, and compiles the code of a promise.
fn compile(toolchain: &str, promise: Promise) -> Outcome {
    let mut install = Command::new("rustup");
    install.args(["toolchain", "install", toolchain, "--profile", "minimal"]);
    if let Some(target) = promise.target {
        install.args(["--target", target]);
    }
    run(install, &format!("rustup toolchain install {toolchain}"))?;
    // Each compiler has its own folder; if they shared one, each would compile everything again.
    let folder = format!("target/rust_version/{toolchain}");
    let mut arguments = vec!["check", "--locked", "--target-dir", &folder];
    arguments.extend(promise.code);
    if let Some(target) = promise.target {
        arguments.extend(["--target", target]);
    }
    cargo_of(toolchain, &arguments, &[])
}

/// Returns the numbers of a version, such as `[1, 95, 0]` of `1.95.0-nightly`.
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
    fn the_promised_version_compiles_unless_it_is_the_running_one() {
        assert_eq!(needed("1.95", "1.95.0"), Check::Same);
        assert_eq!(needed("1.95", "1.95.1"), Check::Same);
        assert_eq!(needed("1.95", "1.94.9"), Check::Above);
        assert_eq!(
            needed("1.95", "1.100.0"),
            Check::CompileWith("1.95.0".into())
        );
        assert_eq!(
            needed("1.95.1", "1.96.0"),
            Check::CompileWith("1.95.1".into())
        );
    }
}
