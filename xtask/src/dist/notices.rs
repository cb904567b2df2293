//! Licences and bill of materials of what the command is built from, by cargo-about with `about.toml`.

use std::fs;
use std::path::{Path, PathBuf};

use super::tree::failed;
use crate::run::{Outcome, cargo, repository};
use crate::tools::CARGO_ABOUT;

/// Both files in one template, because cargo-about searches all packages for each template.
const TEMPLATE: &str = include_str!("notices.hbs");

/// Line between the two.
const BETWEEN: &str = "@@@\n";

/// Names of the two files.
const FILES: [&str; 2] = ["LICENCES-OF-DEPENDENCIES.txt", "dashpot.cdx.json"];

/// Writes the notices into `folder` and returns their paths.
///
/// # Errors
/// A licence is not allowed, cargo-about cannot be installed, or a file cannot be written.
pub fn notices(folder: &Path) -> Outcome<Vec<PathBuf>> {
    CARGO_ABOUT.install()?;
    fs::create_dir_all(folder).map_err(|error| failed(folder, error))?;
    let [template, both] = ["notices.hbs", "notices.txt"].map(|name| folder.join(name));
    let text = TEMPLATE.replace("@VERSION@", env!("CARGO_PKG_VERSION"));
    fs::write(&template, text).map_err(|error| failed(&template, error))?;
    let manifest = repository().join("hil-host/Cargo.toml");
    cargo(&[
        "about",
        "generate",
        "--locked",
        "--offline",
        "--fail",
        "--config",
        "about.toml",
        "--manifest-path",
        &manifest.to_string_lossy(),
        "--output-file",
        &both.to_string_lossy(),
        &template.to_string_lossy(),
    ])?;
    let text = fs::read_to_string(&both).map_err(|error| failed(&both, error))?;
    let mut parts = text.rsplitn(2, BETWEEN);
    let bill = parts.next().unwrap_or_default();
    let licences = parts.next().ok_or("cargo-about wrote no licences")?;
    let written = FILES.map(|name| folder.join(name));
    for (path, content) in written.iter().zip([licences, bill]) {
        fs::write(path, content).map_err(|error| failed(path, error))?;
    }
    Ok(written.into())
}
