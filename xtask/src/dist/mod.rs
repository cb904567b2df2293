//! `cargo xtask dist`: what users install without building. The same commit gives the same bytes.

mod archive;
mod command;
mod debian;
mod notices;
mod options;
mod platform;
mod tree;
mod wheels;

use std::path::PathBuf;
use std::process::Command;

pub use options::Options;
pub use platform::PLATFORMS;

use crate::c_library;
use crate::ci::release_checks;
use crate::reproducible::{FixedPlace, commit_time};
use crate::run::{Outcome, git, repository, run};
use crate::tags::check_interfaces;
use crate::target_toolchain::TargetToolchain;
use platform::Platform;
use tree::Tree;

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Folder of what goes into the archives.
const WORK: &str = "target/dist_work";

/// Committed files and folders in an archive, in the same places, so that links between documents hold.
const FILES: [&str; 14] = [
    "README.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "SECURITY.md",
    "capi/README.md",
    "capi/examples",
    "cluster",
    "data",
    "docs",
    "memory.x",
    "rail/README.md",
];

/// Builds archives, Debian packages, wheels and the list of their digests.
///
/// # Errors
/// The working tree differs from the last commit, an interface changed more than the version allows, a check of
/// [`release_checks`] fails, a tool is missing, or a build fails.
pub fn dist(options: &Options) -> Outcome {
    check_tree(options.allow_changes)?;
    check_interfaces()?;
    release_checks()?;
    let time = commit_time()?;
    let host = PLATFORMS.iter().find(|platform| platform.is_host());
    let host = host.ok_or("archives are built on Linux with x86-64 or aarch64")?;
    for platform in options.platforms.iter().chain([host]) {
        has_target(platform.target)?;
        platform.python.map_or(Ok(()), has_target)?;
    }
    let work = repository().join(WORK);
    let notices = notices::notices(&work.join("notices"))?;
    let output = Tree::new(options.output.clone())?;
    let described = Tree::new(work.join("described"))?;
    command::describe(&command::build(host)?, &described)?;
    for platform in &options.platforms {
        let name = format!("dashpot-{VERSION}-{}", platform.name);
        let tree = Tree::new(work.join(&name))?;
        fill(&tree, platform, &notices, &described)?;
        let file = |ending: &str| output.folder().join(format!("{name}{ending}"));
        match platform.debian {
            None => archive::zip(&work, &name, &file(".zip"))?,
            Some(architecture) => {
                archive::tar_gz(&work, &name, &file(".tar.gz"), &time)?;
                let package = format!("dashpot_{VERSION}_{architecture}.deb");
                let files = Tree::new(work.join("debian"))?;
                let package = output.folder().join(package);
                debian::debian(tree.folder(), &files, architecture, &package, &time)?;
            }
        }
        wheels::wheel(platform, output.folder(), &time)?;
    }
    wheels::sources(output.folder(), &time)?;
    archive::digests(output.folder())?;
    println!("{}", output.folder().display());
    Ok(())
}

/// Puts everything that a platform's users get into its tree.
fn fill(tree: &Tree, platform: &Platform, notices: &[PathBuf], described: &Tree) -> Outcome {
    let program = command::build(platform)?;
    tree.copy(&program, &format!("bin/{}", platform.program()))?;
    for path in FILES {
        tree.copy_committed(path)?;
    }
    for notice in notices {
        let name = notice.file_name().unwrap_or_default().to_string_lossy();
        tree.copy(notice, &format!("share/doc/dashpot/{name}"))?;
    }
    for folder in [
        "share/man",
        "share/bash-completion",
        "share/zsh",
        "share/fish",
    ] {
        tree.copy_folder(&described.folder().join(folder), folder)?;
    }
    let libraries = repository().join(WORK).join("c");
    let place = FixedPlace::new()?;
    let manifest = place.path().join("capi/Cargo.toml");
    for library in platform.c_libraries() {
        library
            .check_tools()
            .map_err(|lack| format!("C library for {}: {lack}", library.name()))?;
        let built = c_library::install_from(&manifest, &library, &libraries)?;
        tree.copy_folder(&built, &format!("c/{}", library.name()))?;
    }
    Ok(())
}

/// Installs the library of a target from rustup.
fn has_target(target: &str) -> Outcome {
    if TargetToolchain::installed(target).is_some() {
        return Ok(());
    }
    let mut rustup = Command::new("rustup");
    rustup.args(["target", "add", target]);
    run(rustup, &format!("rustup target add {target}"))
}

/// An archive is that of a commit.
fn check_tree(allow_changes: bool) -> Outcome {
    let changes = git(&["status", "--porcelain"])?;
    match changes.lines().next() {
        Some(first) if !allow_changes => Err(format!(
            "files differ from the last commit, so the archives would be of no commit: `{first}`. Commit them, or \
             build with --allow-changes"
        )),
        _ => Ok(()),
    }
}
