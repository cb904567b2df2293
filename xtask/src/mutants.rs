//! `cargo xtask mutants`: makes small changes to the code that must not break, one at a time, and lists the changes
//! that no test notices.
//!
//! `.cargo/mutants.toml` lists the surviving changes that were judged harmless, each with its reason.

use std::fs;
use std::path::PathBuf;

use crate::run::{Outcome, cargo, repository};
use crate::tools::CARGO_MUTANTS;

/// Code that is changed, and the tests that must notice the changes.
#[derive(Debug, PartialEq, Eq)]
pub struct Area {
    /// Name on the command line.
    pub name: &'static str,
    /// Package of the code.
    pub package: &'static str,
    /// Paths relative to the repository's folder; `*` matches a name and `**` any folders.
    pub files: &'static [&'static str],
    /// Packages whose tests are run.
    pub tested: &'static [&'static str],
    /// Arguments of `cargo test` that select the tests.
    pub tests: &'static [&'static str],
}

/// Areas in the order in which they are run.
pub const AREAS: [Area; 6] = [
    Area {
        name: "step",
        package: "dashpot-core",
        files: &[
            "core/src/step.rs",
            "core/src/stages.rs",
            "core/src/unusual.rs",
            "core/src/bins.rs",
            "core/src/table.rs",
            "core/src/real.rs",
            "core/src/state.rs",
            "core/src/status.rs",
            "core/src/integrity.rs",
            "core/src/bank.rs",
            "core/src/math/*.rs",
        ],
        tested: &["dashpot-core", "dashpot"],
        tests: &[
            "--lib",
            "--test",
            "damper",
            "--test",
            "determinism",
            "--test",
            "regressions",
        ],
    },
    Area {
        name: "health",
        package: "dashpot-core",
        files: &["core/src/health/**/*.rs"],
        tested: &["dashpot-core", "dashpot"],
        tests: &["--lib", "--test", "health"],
    },
    Area {
        name: "engine",
        package: "dashpot-rail",
        files: &["rail/src/vehicle/engine/**/*.rs"],
        tested: &["dashpot-rail", "dashpot"],
        tests: &["--lib", "--test", "vehicle"],
    },
    Area {
        name: "track",
        package: "dashpot-rail",
        files: &["rail/src/track/**/*.rs"],
        tested: &["dashpot-rail"],
        tests: &["--lib", "--test", "track", "--test", "vehicle"],
    },
    Area {
        name: "indices",
        package: "dashpot-rail",
        files: &["rail/src/indices/**/*.rs"],
        tested: &["dashpot-rail"],
        tests: &["--lib", "--test", "indices", "--test", "contact"],
    },
    Area {
        name: "recordings",
        package: "dashpot-recording",
        files: &["recording/src/**/*.rs"],
        tested: &["dashpot-recording", "dashpot-hil"],
        tests: &["--lib", "--test", "recordings"],
    },
];

/// Runs the areas with these names, or all areas without names.
///
/// This takes hours. The results are in `target/mutants/NAME`.
///
/// # Errors
/// An area is unknown, cargo-mutants cannot be installed, or a change survived.
pub fn mutants(names: &[&str]) -> Outcome {
    let areas = select(names)?;
    CARGO_MUTANTS.install()?;
    let run = |area: &&Area| {
        let folder = output(area);
        let created =
            fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()));
        let arguments = arguments(area);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let outcome = created.and_then(|()| cargo(&arguments));
        outcome.err().map(|error| format!("{}: {error}", area.name))
    };
    let failures: Vec<String> = areas.iter().filter_map(run).collect();
    if failures.is_empty() {
        Ok(())
    } else {
        Err(failures.join("\n"))
    }
}

/// Returns the areas with these names, or all areas without names.
///
/// # Errors
/// A name is unknown.
pub fn select(names: &[&str]) -> Outcome<Vec<&'static Area>> {
    if names.is_empty() {
        return Ok(AREAS.iter().collect());
    }
    let find = |name: &&str| {
        AREAS.iter().find(|area| area.name == *name).ok_or_else(|| {
            let known = AREAS.each_ref().map(|area| area.name).join(", ");
            format!("mutants: `{name}` is unknown, allowed: {known}")
        })
    };
    names.iter().map(find).collect()
}

/// Returns the folder for the results of an area.
fn output(area: &Area) -> PathBuf {
    repository().join("target/mutants").join(area.name)
}

fn arguments(area: &Area) -> Vec<String> {
    let mut arguments = vec![
        "mutants".to_owned(),
        "--no-shuffle".into(),
        "--package".into(),
        area.package.into(),
    ];
    arguments.extend([
        "--output".into(),
        output(area).to_string_lossy().into_owned(),
    ]);
    for file in area.files {
        arguments.extend(["--file".into(), (*file).to_owned()]);
    }
    for package in area.tested {
        arguments.extend(["--test-package".into(), (*package).to_owned()]);
    }
    arguments.push("--".into());
    arguments.extend(area.tests.iter().map(|argument| (*argument).to_owned()));
    arguments
}

#[cfg(test)]
mod tests {
    use super::{AREAS, arguments, select};
    use crate::run::repository;

    #[test]
    fn areas_are_selected_by_name() {
        let names = |names: &[&str]| {
            select(names).map(|areas| areas.iter().map(|area| area.name).collect::<Vec<_>>())
        };
        assert_eq!(names(&["engine", "step"]), Ok(vec!["engine", "step"]));
        assert_eq!(names(&[]).map(|names| names.len()), Ok(AREAS.len()));
        assert!(
            names(&["steps"])
                .unwrap_err()
                .contains("allowed: step, health")
        );
    }

    #[test]
    fn tests_come_after_the_files_and_packages() {
        let line = arguments(&AREAS[1]).join(" ");
        let expected = "--file core/src/health/**/*.rs --test-package dashpot-core --test-package dashpot \
                        -- --lib --test health";
        assert!(line.ends_with(expected), "{line}");
    }

    #[test]
    fn there_is_code_at_every_path() {
        for path in AREAS.iter().flat_map(|area| area.files) {
            let fixed = path.split('*').next().unwrap_or_default();
            assert!(repository().join(fixed).exists(), "{path}");
        }
    }
}
