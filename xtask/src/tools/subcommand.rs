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
pub const CARGO_HACK: Subcommand = Subcommand {
    package: "cargo-hack",
    version: "0.6.46",
    is_debug: false,
};
/// Builds and runs fuzz targets.
pub const CARGO_FUZZ: Subcommand = Subcommand {
    package: "cargo-fuzz",
    version: "0.13.2",
    is_debug: false,
};
/// Makes small changes to the code, one at a time, and lists the changes that no test notices.
pub const CARGO_MUTANTS: Subcommand = Subcommand {
    package: "cargo-mutants",
    version: "27.1.0",
    is_debug: false,
};
/// Finds changes to a public interface that the version number does not allow.
pub const CARGO_SEMVER_CHECKS: Subcommand = Subcommand {
    package: "cargo-semver-checks",
    version: "0.51.0",
    is_debug: false,
};
/// Collects the licences of dependencies.
pub const CARGO_ABOUT: Subcommand = Subcommand {
    package: "cargo-about",
    version: "0.9.3",
    is_debug: false,
};
/// Checks licences, sources, duplicate versions and published weaknesses of dependencies.
pub const CARGO_DENY: Subcommand = Subcommand {
    package: "cargo-deny",
    version: "0.20.2",
    is_debug: true,
};

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
