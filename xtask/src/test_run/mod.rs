//! Runs every test of the repository, then lists those that were skipped.

mod programs;
mod queue;

use crate::run::{Outcome, cargo_with, repository};
use crate::setup::install_for_tests;
use crate::tools::SKIPPED;

/// Runs of cargo after the test programs: the examples in documents, and the tests of the C library, which is a
/// workspace of its own.
const RUNS: [&[&str]; 2] = [
    &["test", "--workspace", "--doc", "--no-fail-fast"],
    &["test", "--manifest-path", "capi/Cargo.toml"],
];

/// Installs the tools that tests need, runs every test, and lists those that were skipped and why.
///
/// # Errors
/// Tests failed. All tests were run nevertheless.
pub fn test() -> Outcome {
    install_for_tests();
    let path = repository().join("target/skipped_tests.txt");
    let _ = std::fs::remove_file(&path);
    let variables = [(SKIPPED, &*path.to_string_lossy())];
    let mut failures: Vec<String> = queue::run_all(&programs::built()?, &variables)?;
    let runs = RUNS.iter();
    failures.extend(runs.filter_map(|arguments| cargo_with(arguments, &variables).err()));
    println!(
        "\n{}",
        summary(&std::fs::read_to_string(&path).unwrap_or_default())
    );
    if failures.is_empty() {
        Ok(())
    } else {
        Err(failures.join("\n"))
    }
}

/// Returns the summary printed at the end, from the lines that skipped tests wrote.
fn summary(skipped: &str) -> String {
    let mut lines: Vec<&str> = skipped.lines().collect();
    lines.sort_unstable();
    lines.dedup();
    match lines.len() {
        0 => "no test was skipped".into(),
        count => format!("skipped, {count}:\n  {}", lines.join("\n  ")),
    }
}

#[cfg(test)]
mod tests {
    use super::summary;

    #[test]
    fn every_skipped_test_is_listed_once() {
        assert_eq!(summary(""), "no test was skipped");
        let text =
            summary("b (QEMU); to run it: x\na (gcc); to run it: y\nb (QEMU); to run it: x\n");
        assert_eq!(
            text,
            "skipped, 2:\n  a (gcc); to run it: y\n  b (QEMU); to run it: x"
        );
    }
}
