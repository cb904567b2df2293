//! The code that mutation tests change, and the tests that must notice.

/// Code that is changed, and the tests that must notice the changes.
#[derive(Debug, PartialEq, Eq)]
pub struct Area {
    /// Name on the command line.
    pub name: &'static str,
    /// Package of the code.
    pub package: &'static str,
    /// Paths relative to the repository's folder; `*` matches a name and `**` any folders.
    pub files: &'static [&'static str],
    /// Tests in the order in which they run, fast ones first. A later round tries only what no earlier one noticed.
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
            "core/src/bank/*.rs",
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
        rounds: &[Round {
            packages: &["dashpot-rail"],
            tests: &["--lib", "--test", "indices"],
        }],
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
