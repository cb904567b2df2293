//! The engine of the live page as WebAssembly, built so that every machine with the same compiler gets the same bytes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::reproducible::path_flags;
use crate::run::{Outcome, repository, run};
use crate::target_toolchain::TargetToolchain;

/// Target of the module; rustup has its library.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// The committed module.
const MODULE: &str = "page/module/dashpot.wasm";

/// Where cargo builds it.
const FOLDER: &str = "target/web";

/// The compiler that built the committed module, as it prints its version.
const COMPILER: &str = "page/module/compiler.txt";

/// Test that knows the digest of the module's sources.
const SOURCES_TEST: [&str; 6] = [
    "test",
    "--workspace",
    "--test",
    "repository",
    "module_of_the_page",
    "--quiet",
];

/// Builds the module and commits it to the working tree, with the digest of its sources.
///
/// # Errors
/// It cannot be built or written.
pub fn web() -> Outcome {
    // What an earlier state of the sources left there has given other bytes than a new folder.
    match fs::remove_dir_all(repository().join(FOLDER)) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            return Err(format!("{FOLDER}: {error}"));
        }
        _ => {}
    }
    let built = build("dashpot-browser")?;
    let failed = |error: std::io::Error| format!("{MODULE}: {error}");
    fs::copy(&built, repository().join(MODULE)).map_err(failed)?;
    let compiler = TargetToolchain::Installed.version()?;
    fs::write(repository().join(COMPILER), compiler + "\n").map_err(failed)?;
    let mut test = Command::new("cargo");
    test.args(SOURCES_TEST)
        .env("DASHPOT_BLESS", "1")
        .current_dir(repository());
    run(test, "the digest of the module's sources")
}

/// Builds the module again and compares it with the committed one.
///
/// # Errors
/// It cannot be built, or the bytes differ.
pub fn check() -> Outcome {
    let built = build("dashpot-browser")?;
    let read = |path: &Path| fs::read(path).map_err(|error| format!("{}: {error}", path.display()));
    if read(&built)? == read(&repository().join(MODULE))? {
        return Ok(());
    }
    let of = fs::read_to_string(repository().join(COMPILER)).unwrap_or_default();
    let here = TargetToolchain::Installed.version()?;
    Err(format!(
        "{MODULE} is not what its sources give with {here}; it was built by {}. `cargo xtask web` builds it",
        of.trim()
    ))
}

/// Builds the library of a package as a module and returns its path.
///
/// # Errors
/// There is no library for the target, or the package does not compile.
pub fn build(package: &str) -> Outcome<PathBuf> {
    TargetToolchain::installed(TARGET).ok_or_else(|| {
        format!("a page's engine needs its target: run `rustup target add {TARGET}`")
    })?;
    let mut flags = vec!["-Ctarget-feature=+simd128".to_owned()];
    flags.extend(path_flags()?);
    let folder = repository().join(FOLDER);
    let mut cargo = Command::new("cargo");
    cargo
        .args(["rustc", "--locked", "--profile", "web", "--target", TARGET])
        .args(["--package", package, "--lib", "--crate-type", "cdylib"])
        .arg("--target-dir")
        .arg(&folder)
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"))
        // Settings of this machine must not change the bytes.
        .env_remove("CARGO_INCREMENTAL")
        .env_remove("CARGO_PROFILE_WEB_STRIP")
        .current_dir(repository());
    run(cargo, &format!("cargo rustc of {package} for a browser"))?;
    let name = package.replace('-', "_");
    Ok(folder.join(TARGET).join(format!("web/{name}.wasm")))
}
