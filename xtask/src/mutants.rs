//! `cargo xtask mutants`: changes the code that must not break, bit by bit, and lists the changes that no test notices.
//!
//! Survivors that were judged harmless are listed in `.cargo/mutants.toml`, each with its reason.

use std::fs;
use std::path::PathBuf;

use crate::run::{Outcome, cargo, repository};
use crate::tools::CARGO_MUTANTS;

/// Code that is changed, and the tests that must notice.
#[derive(Debug, PartialEq, Eq)]
pub struct Area {
    /// Name on the command line.
    pub name: &'static str,
    /// Package of the code.
    pub package: &'static str,
    /// Paths from the repository's folder; `*` matches a name and `**` any folders.
    pub files: &'static [&'static str],
    /// Tests in the order in which they are run, fast ones first: each round tries what the rounds before did not notice.
    pub rounds: &'static [Round],
}

/// Tests of one round.
#[derive(Debug, PartialEq, Eq)]
pub struct Round {
    /// Packages whose tests are run.
    pub packages: &'static [&'static str],
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
        rounds: &[
            Round {
                packages: &["dashpot-core", "dashpot"],
                tests: &["--lib", "--test", "determinism"],
            },
            Round {
                packages: &["dashpot"],
                tests: &[
                    "--test",
                    "damper",
                    "--test",
                    "regressions",
                    "--",
                    "--skip",
                    "searched",
                ],
            },
        ],
    },
    Area {
        name: "health",
        package: "dashpot-core",
        files: &["core/src/health/**/*.rs"],
        rounds: &[
            Round {
                packages: &["dashpot-core", "dashpot"],
                tests: &[
                    "--lib",
                    "--test",
                    "health",
                    "--",
                    "--skip",
                    "sensor_faults",
                    "--skip",
                    "random",
                    "--skip",
                    "another_law",
                    "--skip",
                    "locomotive",
                    "--skip",
                    "an_hour",
                    "--skip",
                    "faults::a_",
                ],
            },
            Round {
                packages: &["dashpot"],
                tests: &["--test", "health"],
            },
        ],
    },
    Area {
        name: "engine",
        package: "dashpot-rail",
        files: &["rail/src/vehicle/engine/**/*.rs"],
        rounds: &[
            Round {
                packages: &["dashpot-rail"],
                tests: &["--lib", "--test", "vehicle"],
            },
            Round {
                packages: &["dashpot"],
                tests: &["--test", "vehicle"],
            },
        ],
    },
    Area {
        name: "track",
        package: "dashpot-rail",
        files: &["rail/src/track/**/*.rs"],
        rounds: &[
            Round {
                packages: &["dashpot-rail"],
                tests: &["--lib", "--test", "track"],
            },
            Round {
                packages: &["dashpot-rail"],
                tests: &["--test", "vehicle", "--test", "measured"],
            },
        ],
    },
    Area {
        name: "indices",
        package: "dashpot-rail",
        files: &["rail/src/indices/**/*.rs"],
        rounds: &[
            Round {
                packages: &["dashpot-rail"],
                tests: &["--lib", "--test", "indices"],
            },
            Round {
                packages: &["dashpot-rail"],
                tests: &["--test", "contact"],
            },
        ],
    },
    Area {
        name: "recordings",
        package: "dashpot-recording",
        files: &["recording/src/**/*.rs"],
        rounds: &[
            Round {
                packages: &["dashpot-recording"],
                tests: &["--lib", "--tests"],
            },
            Round {
                packages: &["dashpot-hil"],
                tests: &["--test", "recordings"],
            },
        ],
    },
];

/// Runs the areas of these names, or all if there are none. Takes hours; results are in `target/mutants/NAME`. Options
/// are those of cargo-mutants, such as `--jobs 2` or `--shard 0/8`.
///
/// # Errors
/// An area is unknown, cargo-mutants does not install or run, or a change survived all rounds.
pub fn mutants(names: &[&str], options: &[&str]) -> Outcome {
    let areas = select(names)?;
    CARGO_MUTANTS.install()?;
    let failures: Vec<String> = areas
        .iter()
        .filter_map(|area| run(area, options).err())
        .collect();
    if failures.is_empty() {
        Ok(())
    } else {
        Err(failures.join("\n"))
    }
}

/// Runs the rounds of an area until nothing is left.
fn run(area: &Area, options: &[&str]) -> Outcome {
    let folder = output(area);
    let missed = folder.join("mutants.out/missed.txt");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for round in 0..area.rounds.len() {
        let arguments = arguments(area, round, options);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let outcome = cargo(&arguments);
        if outcome.is_ok() {
            return Ok(());
        }
        // A failure without survivors is one of cargo-mutants, such as tests that fail before any change.
        let survivors = fs::read_to_string(&missed).unwrap_or_default();
        if survivors.is_empty() || round + 1 == area.rounds.len() {
            return outcome.map_err(|error| format!("{}: {error}\n{survivors}", area.name));
        }
    }
    Ok(())
}

/// Returns the areas of these names, or all if there are none.
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

/// Returns the arguments of cargo for a round, counted from 0.
fn arguments(area: &Area, round: usize, options: &[&str]) -> Vec<String> {
    let output = output(area);
    let output = output.to_string_lossy();
    let mut arguments = vec![
        "mutants",
        "--no-shuffle",
        "--package",
        area.package,
        "--output",
        &*output,
    ];
    if round > 0 {
        arguments.push("--iterate");
    }
    arguments.extend(options);
    let Round { packages, tests } = &area.rounds[round];
    arguments.extend(area.files.iter().flat_map(|file| ["--file", file]));
    arguments.extend(
        packages
            .iter()
            .flat_map(|package| ["--test-package", package]),
    );
    arguments.push("--");
    arguments.extend(*tests);
    arguments.into_iter().map(str::to_owned).collect()
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
        let line = arguments(&AREAS[2], 0, &["--jobs", "2"]).join(" ");
        let expected = "--jobs 2 --file rail/src/vehicle/engine/**/*.rs --test-package dashpot-rail \
                        -- --lib --test vehicle";
        assert!(line.ends_with(expected), "{line}");
        assert!(!line.contains("--iterate"), "{line}");
        let line = arguments(&AREAS[2], 1, &[]).join(" ");
        assert!(line.contains("--iterate"), "{line}");
    }

    #[test]
    fn there_is_code_at_every_path() {
        for path in AREAS.iter().flat_map(|area| area.files) {
            let fixed = path.split('*').next().unwrap_or_default();
            assert!(repository().join(fixed).exists(), "{path}");
        }
    }
}
