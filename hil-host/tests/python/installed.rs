//! The package, built once for all tests here. `cargo xtask release-checks` tests its wheel.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use xtask::python::{interpreter, make, needed, pip};

use crate::common::{self, program};

/// The package's library, built once.
pub fn built() -> &'static Path {
    static LIBRARY: LazyLock<PathBuf> =
        LazyLock::new(|| common::library::library("lib_dashpot.so", "python"));
    &LIBRARY
}

/// Folder of the package in the repository.
pub fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../python")
}

/// Folder that contains the package as an installed wheel has it, for the path of an interpreter.
pub fn unpacked() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("dashpot");
    fs::create_dir(&target).unwrap();
    for entry in fs::read_dir(package().join("dashpot")).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), target.join(entry.file_name())).unwrap();
        }
    }
    fs::copy(built(), target.join("_dashpot.abi3.so")).unwrap();
    folder
}

/// Interpreter of a new environment with only numpy.
pub fn alone(folder: &Path) -> PathBuf {
    make(folder).unwrap();
    let python = interpreter(folder);
    let needed = needed();
    let needed = needed.to_str().unwrap();
    let arguments = ["--no-index", "--find-links", needed, "numpy"];
    pip(&python, "install", &arguments).unwrap();
    python
}

/// Runs Python in `folder`, which must succeed; returns its output. Environment variables name the command and the
/// folder of contact tables.
pub fn run(python: &Path, folder: &Path, path: Option<&Path>, arguments: &[&str]) -> String {
    let mut command = Command::new(python);
    command
        .args(arguments)
        .current_dir(folder)
        .env_remove("PYTHONPATH")
        .env("DASHPOT_PROGRAM", program())
        .env(
            "DASHPOT_DATA",
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../data"),
        )
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("XDG_CACHE_HOME", env!("CARGO_TARGET_TMPDIR"));
    if let Some(path) = path {
        command.env("PYTHONPATH", path);
    }
    let output = command.output().unwrap();
    let [text, errors] =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(output.status.success(), "{arguments:?}:\n{text}\n{errors}");
    text + &errors
}
