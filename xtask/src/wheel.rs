//! Builds a wheel of the Python package `dashpot`.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::python::{builder, install, interpreter, make, needed, pip};
use crate::run::{Outcome, repository, run};

/// Builds the wheel into `output`, removes older wheels of the package from it, and returns the wheel's path.
///
/// # Errors
/// There is no Python with the module `venv`, maturin cannot be installed, or the package does not build.
pub fn wheel(profile: &str, output: &Path) -> Outcome<PathBuf> {
    let interpreter = builder()?;
    let failed = |error: std::io::Error| format!("{}: {error}", output.display());
    std::fs::create_dir_all(output).map_err(failed)?;
    for old in wheels(output).map_err(failed)? {
        std::fs::remove_file(old).map_err(failed)?;
    }
    let mut maturin = Command::new(&interpreter);
    maturin.args([
        "-m",
        "maturin",
        "build",
        "--locked",
        "--profile",
        profile,
        "--manifest-path",
        "python/Cargo.toml",
        "--interpreter",
    ]);
    maturin.arg(&interpreter).arg("--out").arg(output);
    maturin.current_dir(repository());
    run(maturin, "maturin build --manifest-path python/Cargo.toml")?;
    let mut built = wheels(output).map_err(failed)?;
    built
        .pop()
        .ok_or_else(|| format!("{}: maturin built no wheel", output.display()))
}

/// Builds the wheel as `cargo xtask wheel` does, installs it beside nothing but numpy, and tests what is installed.
///
/// # Errors
/// A package cannot be installed, the wheel does not build, or the test fails.
pub fn check() -> Outcome {
    install()?;
    let wheel = wheel("dist", &repository().join("target/wheels"))?;
    let folder = repository().join("target/wheel_check");
    make(&folder)?;
    let python = interpreter(&folder);
    let [needed, wheel] = [needed(), wheel].map(|path| path.to_string_lossy().into_owned());
    pip(
        &python,
        "install",
        &["--no-index", "--find-links", &needed, &wheel],
    )?;
    let mut test = Command::new(python);
    test.arg(repository().join("python/tests/installed_wheel.py"));
    test.current_dir(&folder);
    run(test, "python/tests/installed_wheel.py")
}

fn wheels(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut wheels = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.starts_with("dashpot-") && name.ends_with(".whl") {
            wheels.push(path);
        }
    }
    Ok(wheels)
}
