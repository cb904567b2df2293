//! Python environments under `target/`, with the packages that tests and wheels need.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, repository, run};
use crate::tools::{PYTHON, skip};

/// Packages that tests need.
const TEST_PACKAGES: [&str; 12] = [
    "asammdf==8.8.28",
    "basedpyright==1.40.2",
    "check-jsonschema==0.39.0",
    "distributed==2026.8.0",
    "fmpy==0.3.32",
    "matplotlib==3.11.2",
    "mypy==2.4.1",
    "pandas==3.1.1",
    "pandas-stubs==3.1.0.261029",
    "pyarrow==26.0.1",
    "pyxcp==0.29.20",
    "zizmor==1.32.0",
];

/// Packages that build wheels.
const WHEEL_PACKAGES: [&str; 1] = ["maturin==1.16.0"];

/// Packages that build what a user installs: zig is the C compiler and linker for other platforms and for old Linux.
const DIST_PACKAGES: [&str; 3] = [
    "cargo-zigbuild==0.24.1",
    "maturin==1.16.0",
    "ziglang==0.17.1",
];

/// The only dependency of the package `dashpot`. Its wheel is kept, so that a test can install both packages without a
/// network.
const DEPENDENCY: &str = "numpy==2.4.6";

/// Debian package that lets Python create environments.
pub const ENVIRONMENTS: &str = "python3-venv";

/// File that lists an environment's packages.
const LIST: &str = "packages.txt";

/// A Python environment.
struct Environment {
    folder: &'static str,
    packages: &'static [&'static str],
}

const TESTS: Environment = Environment {
    folder: "target/python",
    packages: &TEST_PACKAGES,
};
const WHEELS: Environment = Environment {
    folder: "target/maturin",
    packages: &WHEEL_PACKAGES,
};

const DIST: Environment = Environment {
    folder: "target/dist_tools",
    packages: &DIST_PACKAGES,
};

impl Environment {
    fn folder(&self) -> PathBuf {
        repository().join(self.folder)
    }

    fn is_installed(&self) -> bool {
        let folder = self.folder();
        let list = std::fs::read_to_string(folder.join(LIST));
        let has_packages = list.is_ok_and(|list| list.lines().eq(self.packages.iter().copied()));
        has_packages && interpreter(&folder).is_file()
    }

    fn install(&self) -> Outcome {
        if self.is_installed() {
            return Ok(());
        }
        let folder = self.folder();
        make(&folder)?;
        pip(&interpreter(&folder), "install", self.packages)?;
        std::fs::write(folder.join(LIST), self.packages.join("\n"))
            .map_err(|error| format!("cannot write the list of packages: {error}"))
    }
}

/// Creates an environment in `folder`, with pip only.
///
/// # Errors
/// There is no Python, or it lacks the module `venv`.
pub fn make(folder: &Path) -> Outcome {
    let mut make = Command::new(PYTHON.program);
    make.args(["-m", "venv", "--clear"]).arg(folder);
    run(make, &format!("python3 -m venv {}", folder.display()))
}

/// Returns the interpreter of an environment.
pub fn interpreter(folder: &Path) -> PathBuf {
    let path = match cfg!(windows) {
        true => "Scripts/python.exe",
        false => "bin/python",
    };
    folder.join(path)
}

/// Runs an interpreter's pip.
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

/// Returns the folder with the wheel of `DEPENDENCY`, on which the package `dashpot` depends.
pub fn needed() -> PathBuf {
    TESTS.folder().join("needed")
}

fn has_needed() -> bool {
    std::fs::read_dir(needed()).is_ok_and(|mut files| files.next().is_some())
}

/// Returns the Python interpreter with the packages that tests need. It is `None` if they are missing; then the test is
/// skipped, as with [`have`](crate::tools::have).
///
/// # Panics
/// The test is skipped and the variable `CI` is set.
pub fn have_packages(skipped: &str) -> Option<PathBuf> {
    if !(TESTS.is_installed() && has_needed()) {
        skip(skipped, "cargo xtask python");
        return None;
    }
    Some(interpreter(&TESTS.folder()))
}

/// True if Python cannot create environments.
pub fn lacks_environments() -> bool {
    let mut python = Command::new(PYTHON.program);
    let output = python.args(["-c", "import ensurepip"]).output();
    !output.is_ok_and(|output| output.status.success())
}

/// Creates the environment of the tests if it is missing or contains other packages.
///
/// # Errors
/// There is no Python, it lacks the module `venv`, or a package cannot be installed.
pub fn install() -> Outcome {
    TESTS.install()?;
    if has_needed() {
        return Ok(());
    }
    let needed = needed();
    let into = needed.to_string_lossy();
    let download = ["--no-deps", "--only-binary", ":all:", "--dest", &*into];
    pip(
        &interpreter(&TESTS.folder()),
        "download",
        &[&download[..], &[DEPENDENCY]].concat(),
    )
}

/// Returns the Python interpreter that builds wheels; installs its environment if that is missing.
///
/// # Errors
/// There is no Python with the module `venv`, or maturin cannot be installed.
pub fn builder() -> Outcome<PathBuf> {
    WHEELS.install()?;
    Ok(interpreter(&WHEELS.folder()))
}

/// Returns the Python interpreter with zig and what cargo needs to compile with it; installs its environment if that is
/// missing.
///
/// # Errors
/// There is no Python with the module `venv`, or a package cannot be installed.
pub fn cross_builder() -> Outcome<PathBuf> {
    DIST.install()?;
    Ok(interpreter(&DIST.folder()))
}
