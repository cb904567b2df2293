//! Checks of all packages that ours depend on, by cargo-deny with `deny.toml`.

use crate::run::{Outcome, cargo};
use crate::tools::CARGO_DENY;

/// Folders of the workspaces, each with a lock file; the first is the main one.
pub const WORKSPACES: [&str; 5] = [".", "capi", "firmware", "fuzz", "tests/no_std_consumer"];

/// Checks licences, sources and duplicate versions. Needs no network.
///
/// # Errors
/// A package is not allowed, or cargo-deny cannot be installed.
pub fn check() -> Outcome {
    deny(
        &["--offline"],
        &["--show-stats", "licenses", "sources", "bans"],
    )
}

/// Asks the RustSec database for published weaknesses.
///
/// # Errors
/// A package has one, or the database cannot be reached.
pub fn advisories() -> Outcome {
    deny(&[], &["advisories"])
}

/// Checks licences and sources of a workspace that is built for itself. Its packages may have several versions.
///
/// # Errors
/// A package is not allowed, or cargo-deny cannot be installed.
pub fn check_licences(folder: &str) -> Outcome {
    deny_in(&[folder], &["--offline"], &["licenses", "sources"])
}

fn deny(options: &[&str], checks: &[&str]) -> Outcome {
    deny_in(&WORKSPACES, options, checks)
}

fn deny_in(folders: &[&str], options: &[&str], checks: &[&str]) -> Outcome {
    CARGO_DENY.install()?;
    for folder in folders {
        let manifest = format!("{folder}/Cargo.toml");
        let of = ["deny", "--locked", "--manifest-path", &manifest];
        let check = [
            "check",
            "--hide-inclusion-graph",
            "--allow",
            "unmatched-skip",
        ];
        cargo(&[&of[..], options, &["--config", "deny.toml"], &check, checks].concat())?;
    }
    Ok(())
}
