//! What makes a build give the same bytes on every machine with the same compiler.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, git, output_of, repository};

/// Flags of rustc that replace folders of this machine in texts of panics.
///
/// # Errors
/// There is no rustc.
pub fn path_flags() -> Outcome<Vec<String>> {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home
        .or_else(|| Some(std::env::home_dir()?.join(".cargo")))
        .unwrap_or_default();
    let mut rustc = Command::new("rustc");
    rustc.args(["--print", "sysroot"]);
    let sysroot = output_of(rustc, "rustc --print sysroot")?;
    let mut flags = vec![
        format!("--remap-path-prefix={}=dashpot", repository().display()),
        format!("--remap-path-prefix={}=rust", sysroot.trim()),
    ];
    // A registry's folder is named after its address.
    let registries = fs::read_dir(home.join("registry/src"))
        .into_iter()
        .flatten()
        .flatten();
    flags.extend(
        registries
            .map(|folder| format!("--remap-path-prefix={}=registry", folder.path().display())),
    );
    Ok(flags)
}

/// Returns the time of the last commit, in seconds since 1970: the time of all files in an archive.
///
/// # Errors
/// The repository's folder is no checkout.
pub fn commit_time() -> Outcome<String> {
    Ok(git(&["log", "-1", "--format=%ct"])?.trim().to_owned())
}

/// A link to the repository that has the same path on every Linux. Cargo derives names of symbols from the path of a
/// package outside the workspace, which for the C library is the core.
#[derive(Debug)]
pub struct FixedPlace(());

impl FixedPlace {
    const PATH: &str = "/tmp/dashpot-sources";

    /// Makes the link, which is removed when the value is dropped.
    ///
    /// # Errors
    /// There is such a file already, perhaps of another build.
    pub fn new() -> Outcome<Self> {
        #[cfg(unix)]
        let made = std::os::unix::fs::symlink(repository(), Self::PATH);
        #[cfg(not(unix))]
        let made = Err::<(), _>(std::io::ErrorKind::Unsupported);
        made.map(|()| Self(())).map_err(|error| {
            format!(
                "{}: {error}; remove this link if no other build of archives is running",
                Self::PATH
            )
        })
    }

    /// The path of the link.
    pub fn path(&self) -> &Path {
        Path::new(Self::PATH)
    }
}

impl Drop for FixedPlace {
    fn drop(&mut self) {
        let _ = fs::remove_file(Self::PATH);
    }
}
