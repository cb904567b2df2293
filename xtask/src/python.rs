//! Environments of Python under `target/`, with the packages that tests and wheels need.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, repository, run};
use crate::tools::{PYTHON, skip};

/// Packages of the tests.
const OF_TESTS: [&str; 6] = [
    "asammdf==8.8.28",
    "distributed==2026.8.0",
    "fmpy==0.3.32",
    "mypy==2.4.1",
    "pandas==3.1.1",
    "pyarrow==26.0.1",
];

/// What builds the package `dashpot` of Python.
const OF_WHEELS: [&str; 1] = ["maturin==1.16.0"];

/// All that the package `dashpot` needs beside itself: kept as a file, so that a test installs both where there is no network.
const NEEDED: &str = "numpy==2.4.6";

/// Debian's package without which its Python makes no environments.
pub const ENVIRONMENTS: &str = "python3-venv";

/// Lists the packages that an environment has.
const LIST: &str = "packages.txt";

/// An environment of Python.
struct Environment {
    folder: &'static str,
    packages: &'static [&'static str],
}

const TESTS: Environment = Environment {
    folder: "target/python",
    packages: &OF_TESTS,
};
const WHEELS: Environment = Environment {
    folder: "target/maturin",
    packages: &OF_WHEELS,
};

impl Environment {
    fn folder(&self) -> PathBuf {
        repository().join(self.folder)
    }

    fn is_there(&self) -> bool {
        let folder = self.folder();
        let list = std::fs::read_to_string(folder.join(LIST));
        let is_listed = list.is_ok_and(|list| list.lines().eq(self.packages.iter().copied()));
        is_listed && interpreter(&folder).is_file()
    }

    fn install(&self) -> Outcome {
        if self.is_there() {
            return Ok(());
        }
        let folder = self.folder();
        make(&folder)?;
        pip(&interpreter(&folder), "install", self.packages)?;
        std::fs::write(folder.join(LIST), self.packages.join("\n"))
            .map_err(|error| format!("cannot write the list of packages: {error}"))
    }
}

/// Makes an environment at `folder`, empty but for pip.
///
/// # Errors
/// There is no Python, or it lacks the module `venv`.
pub fn make(folder: &Path) -> Outcome {
    let mut make = Command::new(PYTHON.program);
    make.args(["-m", "venv", "--clear"]).arg(folder);
    run(make, &format!("python3 -m venv {}", folder.display()))
}

/// The interpreter of an environment.
pub fn interpreter(folder: &Path) -> PathBuf {
    let place = match cfg!(windows) {
        true => "Scripts/python.exe",
        false => "bin/python",
    };
    folder.join(place)
}

/// Runs pip of an interpreter.
///
/// # Errors
/// pip fails.
pub fn pip(interpreter: &Path, command: &str, arguments: &[&str]) -> Outcome {
    let mut pip = Command::new(interpreter);
    pip.args(["-m", "pip", command]);
    pip.args(["--quiet", "--disable-pip-version-check"]);
    pip.args(arguments);
    run(pip, &format!("pip {command} {}", arguments.join(" ")))
}

/// Where the files of what the package `dashpot` needs are kept.
pub fn needed() -> PathBuf {
    TESTS.folder().join("needed")
}

fn has_needed() -> bool {
    std::fs::read_dir(needed()).is_ok_and(|mut files| files.next().is_some())
}

/// Python with the packages; `None` as [`have`](crate::tools::have) says `false`.
///
/// # Panics
/// As [`have`](crate::tools::have).
pub fn have_packages(skipped: &str) -> Option<PathBuf> {
    if !(TESTS.is_there() && WHEELS.is_there() && has_needed()) {
        skip(skipped, "cargo xtask python");
        return None;
    }
    Some(interpreter(&TESTS.folder()))
}

/// Whether there is a Python that makes no environments.
pub fn lacks_environments() -> bool {
    let mut python = Command::new(PYTHON.program);
    let output = python.args(["-c", "import ensurepip"]).output();
    !output.is_ok_and(|output| output.status.success())
}

/// Makes the environments with their packages, where they are missing or have others.
///
/// # Errors
/// There is no Python, it lacks the module `venv`, or a package cannot be installed.
pub fn install() -> Outcome {
    TESTS.install()?;
    WHEELS.install()?;
    if has_needed() {
        return Ok(());
    }
    let needed = needed();
    let into = needed.to_string_lossy();
    let download = ["--no-deps", "--only-binary", ":all:", "--dest", &*into];
    pip(
        &interpreter(&TESTS.folder()),
        "download",
        &[&download[..], &[NEEDED]].concat(),
    )
}

/// Python with what builds wheels, installed where it is missing.
///
/// # Errors
/// There is no Python with the module `venv`, or maturin cannot be installed.
pub fn builder() -> Outcome<PathBuf> {
    WHEELS.install()?;
    Ok(interpreter(&WHEELS.folder()))
}
