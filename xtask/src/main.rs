//! Developer commands of Dashpot: `cargo xtask <command>`.

use std::process::ExitCode;

use xtask::c_library::{self, Options, Platform};
use xtask::ci::ci;
use xtask::run::{Outcome, cargo, cargo_output_to_stderr, repository, version_of};
use xtask::rust_version::numbers;
use xtask::search;
use xtask::test_run::test;
use xtask::tools::install_missing;
use xtask::vehicle_validation::vehicle_validation;
use xtask::wheel::wheel;
use xtask::{firmware, nightly, python, slurm};

const HELP: &str = "\
Developer commands of Dashpot

Usage: cargo xtask <command>

Commands:
  test                   install the tools that tests need, then run every test
  firmware               build the images for the target
  target [--format json] measure the core on emulated processors against its budget
  bench                  measure time per step, side by side with yardstick and floor
  bench --instructions   count instructions per step (needs Valgrind and gungraun-runner)
  c-library [--target NAME]... [--output FOLDER]
                         build the C library into an install tree for each target: cortex-m4f,
                         cortex-m7, cortex-m33, x86-64, aarch64; all that this machine can build
                         when none is named; into target/c-library
  search [--evaluations N] [--seed S]
                         search for the damper and motion that come closest to the accuracy promise of docs/numerics.md;
                         4000 motions and seed 1 when not given; writes the worst into target/search
  kalker-book            compute the tables of the recommended creep law anew, from exact theory (some fifteen minutes)
  vehicle-validation     run the studies of docs/vehicle-validation.md anew and write it (some six minutes)
  wheel                  build the package `dashpot` of Python: a wheel in target/wheels, for pip install
  python                 install the packages of Python that tests need, in target/python, and what builds wheels, in target/maturin
  miri                   run the tests of the C interface under Miri (needs a nightly compiler)
  fuzz [--seconds N]     run each fuzz target from its kept seeds for N seconds, 60 when not given (needs a
                         nightly compiler)
  slurm                  prove shards of a study on a real Slurm, one node started for it, and on GNU parallel (two
                         minutes; installs or names Debian's slurm-wlm, munge and parallel)
  ci                     formatting, lints, documentation, Rust version, each feature, test
  help                   this text

Example: cargo xtask test
Exit code: 0 done, 1 a check failed, 2 wrong use.";

/// Of the `gungraun` in Cargo.toml; the runner must be of the same version.
const GUNGRAUN: &str = "0.20";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["help" | "--help" | "-h"] | [_, "--help" | "-h"] => {
            println!("{HELP}");
            Ok(())
        }
        ["test"] => test(),
        ["firmware"] => build_firmware(),
        ["target"] => measure_target(false),
        ["target", "--format", "json"] => measure_target(true),
        ["target", "--format", "text"] => measure_target(false),
        ["bench"] => cargo(&[
            "bench",
            "--package",
            "dashpot",
            "--bench",
            "step",
            "--bench",
            "vehicle",
        ]),
        ["bench", "--instructions"] => count_instructions(),
        ["c-library", ref options @ ..] => match Options::parse(options) {
            Ok(options) => c_library(&options),
            Err(message) => {
                eprintln!("wrong use: {message}");
                return ExitCode::from(2);
            }
        },
        ["search", ref options @ ..] => match search::Options::parse(options) {
            Ok(options) => search::search(options),
            Err(message) => {
                eprintln!("wrong use: {message}");
                return ExitCode::from(2);
            }
        },
        ["kalker-book"] => cargo(&[
            "run",
            "--release",
            "--package",
            "dashpot-reference",
            "--example",
            "kalker_book",
        ]),
        ["vehicle-validation"] => vehicle_validation(),
        ["python"] => python::install(),
        ["wheel"] => build_wheel(),
        ["miri"] => nightly::miri(),
        ["fuzz"] => nightly::fuzz(60),
        ["fuzz", "--seconds", text] => match text.parse() {
            Ok(seconds @ 1..=86_400) => nightly::fuzz(seconds),
            _ => {
                eprintln!("wrong use: --seconds {text}: must be a whole number of 1 to 86400");
                return ExitCode::from(2);
            }
        },
        ["slurm"] => slurm::slurm(),
        ["ci"] => ci(),
        _ => {
            eprintln!("wrong use: `{}`\n\n{HELP}", words.join(" "));
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn build_firmware() -> Outcome {
    println!("images are in {}", firmware::build_default()?.display());
    Ok(())
}

fn build_wheel() -> Outcome {
    let path = wheel("release", &repository().join("target/wheels"))?;
    println!("python3 -m pip install {}", path.display());
    Ok(())
}

/// Installs for the platforms named; where none is, for all but those that lack a tool, which is said.
fn c_library(options: &Options) -> Outcome {
    let named = !options.platforms.is_empty();
    let all = &Platform::ALL[..];
    for platform in if named { &options.platforms } else { all } {
        let name = platform.name();
        match platform.check_tools() {
            Err(lack) if named => return Err(format!("--target {name}: {lack}")),
            Err(lack) => println!("{name:10}  left out: {lack}"),
            Ok(()) => {
                let tree = c_library::install(platform, &options.output)?;
                println!("{name:10}  {}", tree.display());
            }
        }
    }
    Ok(())
}

/// Runs the test that holds the budget and prints what it measured.
fn measure_target(json: bool) -> Outcome {
    install_missing();
    let path = repository().join("target/target_figures.json");
    let _ = std::fs::remove_file(&path);
    let held = cargo_output_to_stderr(
        &[
            "test",
            "--package",
            "dashpot",
            "--test",
            "target",
            "processors",
        ],
        &[("DASHPOT_TARGET_REPORT", &path.to_string_lossy())],
    );
    let report = std::fs::read_to_string(&path).unwrap_or_default();
    if report.is_empty() {
        return held.and(Err("nothing was measured: see above what is missing".into()));
    }
    if json {
        print!("{report}");
    } else {
        // The objects, without what only separates.
        for line in report.lines().filter(|line| line.contains("\": ")) {
            println!("{}", line.replace(['"', '{', ','], "").trim_end());
        }
    }
    held
}

fn count_instructions() -> Outcome {
    version_of("valgrind", &["--version"])
        .map_err(|error| format!("{error}; install Valgrind, e.g. apt-get install valgrind"))?;
    let install = format!("cargo install gungraun-runner --version '^{GUNGRAUN}'");
    let runner = version_of("gungraun-runner", &["--version"])
        .map_err(|error| format!("{error}; {install}"))?;
    if !numbers(&runner).starts_with(&numbers(GUNGRAUN)) {
        return Err(format!(
            "gungraun-runner is {runner}, the bench needs {GUNGRAUN}: {install}"
        ));
    }
    cargo(&[
        "bench",
        "--package",
        "dashpot",
        "--features",
        "gungraun",
        "--bench",
        "instructions",
    ])
}
