//! Bounds on the packages and processor time of a build. Wall time has no bound: it depends on the machine's load.

use std::collections::BTreeSet;

use crate::run::{Outcome, cargo_output};

/// For each package, the maximum number of packages in its build for this machine's platform, including itself.
const MAX_PACKAGES: [(&str, usize); 2] = [
    // The default build. `dashpot live` serves a page and a WebSocket, which needs five packages of others and two of
    // ours. Packages and processor time that each choice adds to the release build (s of a core that others used too,
    // so only to be compared with each other):
    //
    // | choice | packages | s |
    // |---|---|---|
    // | tungstenite 0.30 without its handshake, httparse, sha1 | 5 | 4.3 |
    // | tungstenite 0.30 with its handshake | 9 | 12.8 |
    // | tungstenite 0.28 with its handshake, tiny_http | 22 | 29.3 |
    // | tokio-tungstenite 0.28, hyper 1 | 35 | 42.5 |
    // | axum 0.8 with ws | 43 | 52.1 |
    //
    // The first is enough: two threads a viewer are simple and never wait for each other, and the handshake is one
    // header in and one out.
    ("dashpot-hil", 180),
    // An FMU links this package, so it must not need commands, plots, signals or differential equations.
    ("dashpot-vehicle-model", 80),
];

/// Maximum processor time of `cargo run --release` from scratch, in seconds of the reference processor: two of its
/// cores provide this in two minutes.
const MAX_PROCESSOR_S: f64 = 240.0;

/// Allowance for the error of the estimated slowness.
const MARGIN: f64 = 1.1;

/// Checks the number of packages in the builds of the command and of the FMU's library. Compiles nothing.
///
/// # Errors
/// A package is built from too many packages.
pub fn check_packages() -> Outcome {
    let mut failures = Vec::new();
    for (package, max) in MAX_PACKAGES {
        let tree = [
            "tree",
            "--locked",
            "--package",
            package,
            "--edges",
            "normal",
            "--prefix",
            "none",
        ];
        let count = packages(&cargo_output(&tree)?).len();
        println!("{package} is built from {count} packages, at most {max} are allowed");
        if count > max {
            failures.push(format!(
                "{package} is built from {count} packages, at most {max} are allowed"
            ));
        }
    }
    if failures.is_empty() {
        Ok(())
    } else {
        Err(failures.join("\n"))
    }
}

/// Names and versions in what `cargo tree --prefix none` prints.
fn packages(tree: &str) -> BTreeSet<&str> {
    // ` (*)` marks a package whose dependencies were printed before.
    let lines = tree.lines().map(|line| line.trim_end_matches(" (*)"));
    lines.filter(|line| !line.is_empty()).collect()
}

/// Checks the processor time of the command's build on a processor with the given slowness (see `slowness.rs`).
///
/// # Errors
/// The processor time is above the bound.
pub fn check_processor_time(total_s: f64, slowness: f64) -> Outcome {
    let max = MAX_PROCESSOR_S * slowness * MARGIN;
    if total_s <= max {
        return Ok(());
    }
    Err(format!(
        "the command's build took {total_s:.0} s of processor time, at most {max:.0} s are allowed: \
         {MAX_PROCESSOR_S} s, times {slowness:.2} for the slowness of this processor, times {MARGIN} for its error"
    ))
}

#[cfg(test)]
mod tests {
    use super::{MARGIN, MAX_PROCESSOR_S, check_processor_time, packages};

    #[test]
    fn a_package_that_is_printed_twice_counts_once() {
        let tree = "a v1.0.0 (/a)\nb v0.1.0\nc v2.0.0\nb v0.1.0 (*)\nb v0.2.0\n\n";
        assert_eq!(packages(tree).len(), 4);
    }

    #[test]
    fn a_slow_processor_is_allowed_for() {
        let max = MAX_PROCESSOR_S * MARGIN;
        assert_eq!(check_processor_time(max, 1.0), Ok(()));
        assert_eq!(check_processor_time(1.5 * max, 1.6), Ok(()));
        let error = check_processor_time(1.5 * max + 1.0, 1.5).unwrap_err();
        assert!(error.contains("at most 396 s are allowed"), "{error}");
    }
}
