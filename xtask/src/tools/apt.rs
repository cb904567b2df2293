//! Installs Debian packages.

use std::path::Path;
use std::process::Command;

use crate::run::Outcome;

/// Installs packages with apt-get, as root.
///
/// # Errors
/// The user is not root, there is no apt-get, or it failed. The message contains the command to run by hand.
pub fn install(packages: &[&str]) -> Outcome {
    let line = format!("apt-get install --yes {}", packages.join(" "));
    if !is_root() || !Path::new("/usr/bin/apt-get").exists() {
        return Err(format!("tools are missing; run as root: {line}"));
    }
    let apt_get = |arguments: &[&str], packages: &[&str]| {
        let mut command = Command::new("apt-get");
        command.args(arguments).args(packages);
        command.env("DEBIAN_FRONTEND", "noninteractive");
        command.status().is_ok_and(|status| status.success())
    };
    // If the package list cannot be updated, the old one may still be good enough.
    let _ = apt_get(&["update"], &[]);
    if apt_get(&["install", "--yes", "--no-install-recommends"], packages) {
        Ok(())
    } else {
        Err(format!("`{line}` failed"))
    }
}

fn is_root() -> bool {
    let id = Command::new("id").arg("-u").output();
    id.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}
