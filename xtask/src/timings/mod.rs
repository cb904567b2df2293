//! `cargo xtask timings`: measures the processor time of a build from scratch, crate by crate.

mod bounds;
mod chain;
mod report;
mod slowness;
mod step;
mod unit;
mod wrapper;

use std::ffi::OsStr;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

pub use bounds::check_packages;
pub use wrapper::{LOG, compile};

use crate::run::{Outcome, output_of, repository, run};
use unit::Unit;
use wrapper::child_processor_seconds;

/// What to build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Build {
    /// The command, as `cargo run --release` builds it.
    Command,
    /// Every test of the workspace.
    Tests,
}

impl Build {
    fn arguments(self) -> &'static [&'static str] {
        match self {
            Self::Command => &["build", "--release"],
            Self::Tests => &["test", "--workspace", "--no-run"],
        }
    }
}

/// Builds into an empty folder, prints the processor time of each package, and checks the bound of the command's build.
///
/// # Errors
/// The build fails, this is not Linux, or the command's build exceeds its time limit.
pub fn timings(build: Build) -> Outcome {
    let folder = repository().join("target/timings");
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    let log = folder.join("units.txt");

    let before_s = child_processor_seconds()?;
    let start = Instant::now();
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(build.arguments()).current_dir(repository());
    cargo.env("CARGO_TARGET_DIR", target_folder());
    // This replaces any other wrapper, such as a cache, which would hide the time it saves.
    cargo.env("RUSTC_WRAPPER", std::env::current_exe().map_err(failed)?);
    cargo.env_remove("RUSTC_WORKSPACE_WRAPPER").env(LOG, &log);
    run(cargo, &format!("cargo {}", build.arguments().join(" ")))?;
    let wall_s = start.elapsed().as_secs_f64();
    let total_s = child_processor_seconds()? - before_s;

    let text = fs::read_to_string(&log).map_err(failed)?;
    let units: Vec<Unit> = text.lines().map(str::parse).collect::<Outcome<_>>()?;
    println!("{}", report::report(&units, total_s, wall_s));
    match build {
        Build::Command => {
            let slowness = slowness::slowness(&units)?;
            println!(
                "slowness        {slowness:.2} of the reference processor (xtask/src/timings/slowness.rs)"
            );
            bounds::check_processor_time(total_s, slowness)
        }
        Build::Tests => Ok(()),
    }
}

/// Builds the command with [`timings`], then runs its demonstration: README's first command.
///
/// # Errors
/// The build or the demonstration fails, this is not Linux, or the build or a step exceeds its bound.
pub fn build_and_demonstrate() -> Outcome {
    timings(Build::Command)?;
    let program = target_folder().join("release/dashpot");
    output_of(Command::new(&program), &program.to_string_lossy())?;
    if cfg!(target_arch = "x86_64") {
        step::check(&program)?;
    }
    Ok(())
}

fn target_folder() -> PathBuf {
    repository().join("target/timings/build")
}

/// True if cargo started this program as a wrapper of rustc.
pub fn is_compiler() -> bool {
    std::env::var_os(LOG).is_some_and(|log| log != OsStr::new(""))
}
