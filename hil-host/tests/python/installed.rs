//! The wheel, built once for all tests here, and what it is installed with.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use xtask::python::{interpreter, make, needed, pip};
use xtask::wheel::wheel;

use crate::common::program;

/// The wheel, of the profile that tests are built in.
pub fn built() -> &'static Path {
    static WHEEL: LazyLock<PathBuf> = LazyLock::new(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wheels");
        wheel("dev", &folder).unwrap()
    });
    &WHEEL
}

/// The package's folder in the repository.
pub fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../python")
}

/// A folder with the package, for the path of an interpreter that has what else it needs.
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

/// The interpreter of a new environment that has the package and numpy, and nothing else.
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

/// Runs Python in `folder`, where it must end well; what it printed. The command is named to it, and the folder of kept contact tables.
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
