//! Packages of Python that tests read and write files with, in an environment of their own under `target/`.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, repository, run};
use crate::tools::{PYTHON, skip};

/// The packages.
pub const PACKAGES: [&str; 4] = [
    "asammdf==8.8.28",
    "fmpy==0.3.32",
    "pandas==3.1.1",
    "pyarrow==26.0.1",
];

/// Debian's package without which its Python makes no environments.
pub const ENVIRONMENTS: &str = "python3-venv";

/// Lists the packages that the environment has.
const LIST: &str = "packages.txt";

fn folder() -> PathBuf {
    repository().join("target/python")
}

fn interpreter(folder: &Path) -> PathBuf {
    let place = match cfg!(windows) {
        true => "Scripts/python.exe",
        false => "bin/python",
    };
    folder.join(place)
}

fn is_there(folder: &Path) -> bool {
    let list = std::fs::read_to_string(folder.join(LIST));
    list.is_ok_and(|list| list.lines().eq(PACKAGES)) && interpreter(folder).is_file()
}

/// Python with the packages; `None` as [`have`](crate::tools::have) says `false`.
///
/// # Panics
/// As [`have`](crate::tools::have).
pub fn have_packages(skipped: &str) -> Option<PathBuf> {
    let folder = folder();
    if !is_there(&folder) {
        skip(skipped, "cargo xtask python");
        return None;
    }
    Some(interpreter(&folder))
}

/// Whether there is a Python that makes no environments.
pub fn lacks_environments() -> bool {
    let mut python = Command::new(PYTHON.program);
    let output = python.args(["-c", "import ensurepip"]).output();
    !output.is_ok_and(|output| output.status.success())
}

/// Makes the environment with its packages, where it is missing or has others.
///
/// # Errors
/// There is no Python, it lacks the module `venv`, or a package cannot be installed.
pub fn install() -> Outcome {
    let folder = folder();
    if is_there(&folder) {
        return Ok(());
    }
    let mut make = Command::new(PYTHON.program);
    make.args(["-m", "venv", "--clear"]).arg(&folder);
    run(make, &format!("python3 -m venv {}", folder.display()))?;
    let mut pip = Command::new(interpreter(&folder));
    pip.args([
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ]);
    pip.args(PACKAGES);
    run(pip, &format!("pip install {}", PACKAGES.join(" ")))?;
    std::fs::write(folder.join(LIST), PACKAGES.join("\n"))
        .map_err(|error| format!("cannot write the list of packages: {error}"))
}
