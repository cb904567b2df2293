//! Tells the command from which commit it was built.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo:rerun-if-env-changed=DASHPOT_COMMIT");
    let given = std::env::var("DASHPOT_COMMIT").ok();
    let commit = given.or_else(commit).unwrap_or_else(|| "not known".into());
    println!("cargo:rustc-env=DASHPOT_COMMIT={commit}");
}

/// The commit of the checkout, in a release build only: a development build would be compiled again after each commit.
fn commit() -> Option<String> {
    if std::env::var("PROFILE").ok()? != "release" {
        return Some("of a development build".into());
    }
    let log = Path::new("../.git/logs/HEAD");
    if log.exists() {
        println!("cargo:rerun-if-changed={}", log.display());
    }
    let git = Command::new("git")
        .args(["rev-parse", "--short=12", "HEAD"])
        .output()
        .ok()?;
    let name = String::from_utf8(git.stdout).ok()?;
    git.status.success().then(|| name.trim().to_owned())
}
