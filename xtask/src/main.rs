//! Developer commands of Dashpot: `cargo xtask <command>`.

use std::process::ExitCode;

use xtask::board::board;
use xtask::book::book;
use xtask::c_library::{self, Options, Platform};
use xtask::ci::{ci, release_checks};
use xtask::run::{Outcome, cargo, repository};
use xtask::search;
use xtask::test_run::test;
use xtask::timings::{Build, timings};
use xtask::vehicle_validation::vehicle_validation;
use xtask::web::web;
use xtask::wheel::wheel;
use xtask::{
    bench, dependencies, dist, firmware, mutants, nightly, python, slurm, timings as compiler,
};

const HELP: &str = "\
Developer commands of Dashpot

Usage: cargo xtask <command>

Commands:
  test                   install the tools that tests need, then run every test
  ci                     formatting, lints, documentation, packages, Rust versions, each feature, build time, test
  release-checks         what ci leaves out: the workspace with its lowest compiler, the page's module built again, the
                         wheel, the image for a board (a quarter of an hour); dist runs it first
  timings [--tests]      build the command, or every test, into an empty folder; print the processor time of each
                         package and check the bounds of the command's build
  firmware               build the images for the emulator, and those without an executor for the board NUCLEO-H753ZI
  board                  check and build the image for the board NUCLEO-H753ZI (docs/board.md; two minutes)
  target [--format json] measure the core on emulated processors against its budget
  bench                  measure times and instructions, and print one table: ours, a yardstick from the same run,
                         their ratio and the goal (docs/performance.md explains the lines)
  bench --instructions   count only instructions on this machine (needs Valgrind and gungraun-runner)
  c-library [--target NAME]... [--output FOLDER]
                         build the C library into an install tree for each target: cortex-m4f, cortex-m7, cortex-m33,
                         x86-64, aarch64. Without --target, build all that this machine can. The default folder is
                         target/c-library.
  search [--evaluations N] [--seed S]
                         search for the damper and motion that come closest to the accuracy promise of docs/numerics.md,
                         with 4000 motions and seed 1 by default; write the worst case to target/search
  mutants [NAME]... [OPTION]...
                         change the code that must not break and list the changes that no test notices (hours; installs
                         cargo-mutants). Names: step, health, engine, track, indices, recordings; all by default.
                         Options are those of cargo-mutants, such as --jobs 2, or --shard 0/8 for an eighth.
  kalker-book            compute the tables of the recommended creep law from exact theory (about fifteen minutes)
  vehicle-validation     run the studies of docs/vehicle-validation.md and write it (about six minutes)
  web                    build the engine of the live page as WebAssembly into page/module (three minutes)
  book                   check the links of the documents, build them as a book in target/book (installs mdBook into
                         target/mdbook if there is none), and write sample reports into it (builds the command)
  wheel                  build the Python package `dashpot`: a wheel in target/wheels, for pip install
  dist [--platform NAME]... [--output FOLDER] [--allow-changes]
                         build what users install: archives, Debian packages, wheels, and the list of their digests,
                         for x86-64-linux, aarch64-linux and x86-64-windows, into target/dist (half an hour; installs
                         zig into target/dist_tools, cargo-about, and the targets)
  python                 install into target/python the Python packages that tests need
  miri                   run the tests of the C interface under Miri (needs a nightly compiler)
  fuzz [--seconds N]     run each fuzz target for N seconds, 60 by default, starting from its kept seeds (needs a
                         nightly compiler)
  advisories             ask for published weaknesses of all dependencies (needs a network; installs cargo-deny)
  slurm                  start a Slurm with one node, and run shards of a study on it and on GNU parallel (two minutes;
                         installs Debian's slurm-wlm, munge and parallel, or prints how to)
  help                   print this text

Example: cargo xtask test
Exit code: 0 done, 1 a check failed, 2 usage error.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if compiler::is_compiler() {
        return compiler::compile(&arguments);
    }
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["help" | "--help" | "-h"] | [_, "--help" | "-h"] => {
            println!("{HELP}");
            Ok(())
        }
        ["test"] => test(),
        ["firmware"] => build_firmware(),
        ["board"] => board().map(|image| println!("image: {}", image.display())),
        ["target"] => measure_target(false),
        ["target", "--format", "json"] => measure_target(true),
        ["target", "--format", "text"] => measure_target(false),
        ["bench"] => bench::bench(),
        ["bench", "--instructions"] => bench::count_instructions(),
        ["c-library", ref options @ ..] => match Options::parse(options) {
            Ok(options) => c_library(&options),
            Err(message) => return usage_error(&message),
        },
        ["search", ref options @ ..] => match search::Options::parse(options) {
            Ok(options) => search::search(options),
            Err(message) => return usage_error(&message),
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
        ["dist", ref options @ ..] => match dist::Options::parse(options) {
            Ok(options) => dist::dist(&options),
            Err(message) => return usage_error(&message),
        },
        ["python"] => python::install(),
        ["web"] => web(),
        ["book"] => book(),
        ["wheel"] => build_wheel(),
        ["miri"] => nightly::miri(),
        ["fuzz"] => nightly::fuzz(60),
        ["fuzz", "--seconds", text] => match text.parse() {
            Ok(seconds @ 1..=86_400) => nightly::fuzz(seconds),
            _ => {
                return usage_error(&format!(
                    "--seconds {text}: must be a whole number of 1 to 86400"
                ));
            }
        },
        ["advisories"] => dependencies::advisories(),
        ["slurm"] => slurm::slurm(),
        ["ci"] => ci(),
        ["release-checks"] => release_checks(),
        ["timings"] => timings(Build::Command),
        ["timings", "--tests"] => timings(Build::Tests),
        ["mutants", ref words @ ..] => {
            let options = words.iter().position(|word| word.starts_with('-'));
            let (names, options) = words.split_at(options.unwrap_or(words.len()));
            match mutants::select(names) {
                Ok(areas) => mutants::mutants(&areas, options),
                Err(message) => return usage_error(&message),
            }
        }
        _ => return usage_error(&format!("`{}`\n\n{HELP}", words.join(" "))),
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
    for folder in firmware::build_default()? {
        println!("images are in {}", folder.display());
    }
    Ok(())
}

fn build_wheel() -> Outcome {
    let path = wheel("dist", &repository().join("target/wheels"))?;
    println!("python3 -m pip install {}", path.display());
    Ok(())
}

fn usage_error(message: &str) -> ExitCode {
    eprintln!("usage error: {message}");
    ExitCode::from(2)
}

/// Installs the library for the named platforms. Without names, installs it for all platforms whose tools are present
/// and prints what the others lack.
fn c_library(options: &Options) -> Outcome {
    let is_named = !options.platforms.is_empty();
    let all = &Platform::ALL[..];
    for platform in if is_named { &options.platforms } else { all } {
        let name = platform.name();
        match platform.check_tools() {
            Err(lack) if is_named => return Err(format!("--target {name}: {lack}")),
            Err(lack) => println!("{name:10}  skipped: {lack}"),
            Ok(()) => {
                let tree = c_library::install(platform, &options.output)?;
                println!("{name:10}  {}", tree.display());
            }
        }
    }
    Ok(())
}

/// Prints what the test that checks the budget measured.
fn measure_target(json: bool) -> Outcome {
    let (report, checked) = bench::measure_target();
    if json {
        print!("{report}");
    } else {
        // Prints the lines with a value, without JSON's punctuation.
        for line in report.lines().filter(|line| line.contains("\": ")) {
            println!("{}", line.replace(['"', '{', ','], "").trim_end());
        }
    }
    checked
}
