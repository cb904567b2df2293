//! Builds the command for a platform, and what it writes about itself.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::platform::Platform;
use super::tree::Tree;
use crate::python::cross_builder;
use crate::reproducible::path_flags;
use crate::run::{Outcome, output_of, repository, run};

/// Folder of the builds, apart from others, because paths are replaced in them.
pub const BUILDS: &str = "target/dist_builds";

/// Shells and the files of their completions.
const COMPLETIONS: [(&str, &str); 3] = [
    ("bash", "share/bash-completion/completions/dashpot"),
    ("zsh", "share/zsh/site-functions/_dashpot"),
    ("fish", "share/fish/vendor_completions.d/dashpot.fish"),
];

/// Builds the command with zig as C compiler and linker, and returns its path.
///
/// # Errors
/// The tools cannot be installed, or it does not build.
pub fn build(platform: &Platform) -> Outcome<PathBuf> {
    let folder = repository().join(BUILDS);
    let mut cargo = with_zig("cargo")?;
    cargo
        .args([
            "zigbuild",
            "--release",
            "--locked",
            "--package",
            "dashpot-hil",
        ])
        .args(["--bin", "dashpot", "--target", platform.target])
        .arg("--target-dir")
        .arg(&folder);
    run(cargo, &format!("cargo zigbuild for {}", platform.name))?;
    Ok(folder
        .join(platform.target)
        .join("release")
        .join(platform.program()))
}

/// A program that finds zig and compiles without paths of this machine.
///
/// # Errors
/// The tools cannot be installed.
pub fn with_zig(program: impl AsRef<std::ffi::OsStr>) -> Outcome<Command> {
    let interpreter = cross_builder()?;
    let tools = interpreter.parent().unwrap_or(Path::new("")).to_owned();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths([tools].into_iter().chain(std::env::split_paths(&path)));
    let mut command = Command::new(program);
    command
        .env("PATH", path.map_err(|error| error.to_string())?)
        .env("CARGO_ENCODED_RUSTFLAGS", path_flags()?.join("\u{1f}"))
        // Settings of this machine must not change the bytes.
        .env_remove("CARGO_INCREMENTAL")
        .env_remove("RUSTFLAGS")
        .current_dir(repository());
    Ok(command)
}

/// Writes completions and manual pages with a command that runs on this machine.
///
/// # Errors
/// It fails, or a file cannot be written.
pub fn describe(command: &Path, tree: &Tree) -> Outcome {
    for (shell, file) in COMPLETIONS {
        let mut completions = Command::new(command);
        completions.args(["completions", shell]);
        tree.write(file, output_of(completions, "dashpot completions")?)?;
    }
    let page = tree.place("share/man/man1/dashpot.1")?;
    let mut pages = Command::new(command);
    pages.args(["man", "--output"]);
    pages.arg(page.parent().unwrap_or(&page));
    output_of(pages, "dashpot man").map(drop)
}
