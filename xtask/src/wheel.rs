//! Builds a wheel of the Python package `dashpot`.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::python::builder;
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
