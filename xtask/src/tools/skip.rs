//! Handles tests that are skipped because a tool is missing: they are printed at once and listed at the end, and fail
//! in CI.

use std::ffi::OsString;
use std::io::Write;

use super::program::{Tool, missing};
use crate::target_toolchain::TargetToolchain;

/// Environment variable that names the file in which skipped tests are listed.
pub const SKIPPED: &str = "DASHPOT_SKIPPED";

/// Returns true if all of `tools` are installed. A test that gets `false` returns without testing `skipped`, which is
/// printed at once and in the summary of `cargo xtask test`.
///
/// # Panics
/// A tool is missing and the variable `CI` is set: CI must not skip tests.
pub fn have(tools: &[Tool], skipped: &str) -> bool {
    let missing = missing(tools);
    if !missing.is_empty() {
        skip(
            skipped,
            &format!("sudo apt-get install {}", missing.join(" ")),
        );
    }
    missing.is_empty()
}

/// Returns the toolchain of a target. A test that gets `None` returns, as with [`have`].
///
/// # Panics
/// The test is skipped and the variable `CI` is set.
pub fn have_target(target: &str, skipped: &str) -> Option<TargetToolchain> {
    TargetToolchain::find(target)
        .inspect_err(|message| skip(skipped, message))
        .ok()
}

/// Returns true if the default compiler has the library of a target. A test that gets `false` returns, as with
/// [`have`].
///
/// # Panics
/// The test is skipped and the variable `CI` is set.
pub fn have_library(target: &str, skipped: &str) -> bool {
    let is_installed = TargetToolchain::installed(target).is_some();
    if !is_installed {
        skip(skipped, &format!("rustup target add {target}"));
    }
    is_installed
}

/// Reports a skipped test with the command that would let it run.
///
/// # Panics
/// The test is skipped and the variable `CI` is set.
pub fn skip(skipped: &str, remedy: &str) {
    let thread = std::thread::current();
    let line = format!(
        "{} ({skipped}); to run it: {remedy}\n",
        thread.name().unwrap_or("a test")
    );
    refuse_in_ci(std::env::var_os("CI"), &line);
    // The test harness captures the `eprintln!` output of passing tests, but not this.
    let _ = std::io::stderr()
        .lock()
        .write_all(format!("\n!!!! SKIPPED: {line}").as_bytes());
    if let Some(path) = std::env::var_os(SKIPPED) {
        let list = std::fs::File::options()
            .create(true)
            .append(true)
            .open(path);
        let _ = list.and_then(|mut list| list.write_all(line.as_bytes()));
    }
}

/// Fails the test if the variable `CI` has a value.
fn refuse_in_ci(ci: Option<OsString>, line: &str) {
    let ci = ci.is_some_and(|value| !value.is_empty());
    assert!(!ci, "CI does not allow skipped tests: {line}");
}

#[cfg(test)]
mod tests {
    use super::refuse_in_ci;

    #[test]
    #[should_panic(expected = "CI does not allow skipped tests: a (QEMU)")]
    fn ci_skips_no_test() {
        refuse_in_ci(None, "a (QEMU)");
        refuse_in_ci(Some("".into()), "a (QEMU)");
        refuse_in_ci(Some("true".into()), "a (QEMU)");
    }
}
