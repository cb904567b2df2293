//! The wheel, built once for all tests here, and its installation.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use xtask::python::{interpreter, make, needed, pip};
use xtask::wheel::wheel;

use crate::common::program;

/// The wheel, built with the profile of the tests.
pub fn built() -> &'static Path {
    static WHEEL: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wheels");
        wheel("dev", &folder).unwrap()
    });
    &WHEEL
}

/// Folder of the package in the repository.
pub fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../python")
}

/// Folder that contains the package, for the path of an interpreter with the other dependencies.
pub fn unpacked(python: &Path) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let (target, wheel) = (folder.path().to_str().unwrap(), built().to_str().unwrap());
    pip(
        python,
        "install",
        &["--no-deps", "--no-index", "--target", target, wheel],
    )
    .unwrap();
    folder
}

/// Interpreter of a new environment with only the package and numpy.
pub fn alone(folder: &Path) -> PathBuf {
    make(folder).unwrap();
    let python = interpreter(folder);
    let needed = needed();
    let (needed, wheel) = (needed.to_str().unwrap(), built().to_str().unwrap());
    pip(
        &python,
        "install",
        &["--no-index", "--find-links", needed, wheel],
    )
    .unwrap();
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
