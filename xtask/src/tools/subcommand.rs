//! Subcommands of cargo that are built from source.

use crate::run::{Outcome, cargo, cargo_output};

/// A subcommand of cargo. Only the developer command that runs it installs it, and only once.
#[derive(Clone, Copy, Debug)]
pub struct Subcommand {
    /// Its package, whose name is `cargo-` and the name of the subcommand.
    package: &'static str,
    version: &'static str,
    /// Whether it is built without optimisation, because building it takes longer than it runs.
    is_debug: bool,
}

/// Runs cargo with each feature.
pub const CARGO_HACK: Subcommand = optimised("cargo-hack", "0.6.46");
/// Builds and runs fuzz targets.
pub const CARGO_FUZZ: Subcommand = optimised("cargo-fuzz", "0.13.2");
/// Makes small changes to the code, one at a time, and lists the changes that no test notices.
pub const CARGO_MUTANTS: Subcommand = optimised("cargo-mutants", "27.1.0");
/// Finds changes to a public interface that the version number does not allow.
pub const CARGO_SEMVER_CHECKS: Subcommand = optimised("cargo-semver-checks", "0.51.0");
/// Collects the licences of dependencies.
pub const CARGO_ABOUT: Subcommand = optimised("cargo-about", "0.9.3");
/// Checks licences, sources, duplicate versions and published weaknesses of dependencies.
pub const CARGO_DENY: Subcommand = Subcommand {
    is_debug: true,
    ..optimised("cargo-deny", "0.20.2")
};

const fn optimised(package: &'static str, version: &'static str) -> Subcommand {
    Subcommand {
        package,
        version,
        is_debug: false,
    }
}

impl Subcommand {
    /// Builds and installs the subcommand if it is missing; any installed version will do.
    ///
    /// # Errors
    /// The subcommand does not build.
    pub fn install(self) -> Outcome {
        let Self {
            package,
            version,
            is_debug,
        } = self;
        let name = package.trim_start_matches("cargo-");
        if cargo_output(&[name, "--version"]).is_ok() {
            return Ok(());
        }
        let mut arguments = vec!["install", "--locked", package, "--version", version];
        if is_debug {
            arguments.push("--debug");
        }
        cargo(&arguments)
    }
}
