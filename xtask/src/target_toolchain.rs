//! Finds what can compile for a processor and prepares cargo for it.
//!
//! First comes the default compiler where it has the target's library, as rustup installs it; then a
//! distribution's compiler with library source (Debian: rustc-web and rust-web-src), which builds `core`
//! itself.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::processor::{CORTEX_M7, Processor};
use crate::run::{Outcome, output_of};

/// Where a distribution puts its compiler.
const SYSTEM_BIN: &str = "/usr/bin";
const SYSTEM_SYSROOT: &str = "/usr";

/// Something that compiles for a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TargetToolchain {
    /// The default compiler, the target's library installed.
    Installed,
    /// A compiler that builds `core` from source first.
    FromSource {
        /// The cargo to run.
        cargo: PathBuf,
        /// The compiler it runs.
        rustc: PathBuf,
    },
}

impl TargetToolchain {
    /// The first toolchain of this machine for a target; a distribution's only for those without an
    /// operating system, for it builds nothing but `core`.
    ///
    /// # Errors
    /// There is none; the message has the command that installs one.
    pub fn find(target: &str) -> Outcome<Self> {
        Self::installed(target)
            .or_else(|| Self::distribution().filter(|_| target.contains("-none-")))
            .ok_or_else(|| {
                format!("nothing here compiles for {target}: run `rustup target add {target}`")
            })
    }

    /// The default compiler, where it has the target's library.
    pub fn installed(target: &str) -> Option<Self> {
        Self::installed_in(&sysroot(Path::new("rustc"))?, target)
    }

    /// A distribution's compiler, where it has the library's source.
    pub fn distribution() -> Option<Self> {
        Self::from_source_in(Path::new(SYSTEM_BIN), Path::new(SYSTEM_SYSROOT))
    }

    fn installed_in(sysroot: &Path, target: &str) -> Option<Self> {
        let library = sysroot.join("lib/rustlib").join(target);
        library.is_dir().then_some(Self::Installed)
    }

    fn from_source_in(bin: &Path, sysroot: &Path) -> Option<Self> {
        let (cargo, rustc) = (bin.join("cargo"), bin.join("rustc"));
        let source = sysroot.join("lib/rustlib/src/rust/library/core/Cargo.toml");
        let all = cargo.exists() && rustc.exists() && source.exists();
        all.then_some(Self::FromSource { cargo, rustc })
    }

    /// The compiler's name and version, as it prints them.
    ///
    /// # Errors
    /// It does not run.
    pub fn version(&self) -> Outcome<String> {
        let mut command = match self {
            Self::Installed => Command::new("rustc"),
            Self::FromSource { rustc, .. } => Command::new(rustc),
        };
        command.arg("--version");
        let printed = output_of(command, "rustc --version")?;
        let words: Vec<&str> = printed.split_whitespace().take(2).collect();
        Ok(words.join(" "))
    }

    /// Where the builds of a package (its folder) for a processor go: a folder for each compiler and
    /// processor, for a Cortex-M7 by the compiler found first cargo's usual one.
    pub fn output_folder(&self, package: &Path, processor: &Processor) -> PathBuf {
        let folder = package.join("target");
        let first = Self::find(processor.target).is_ok_and(|first| first == *self);
        match self {
            _ if first && *processor == CORTEX_M7 => folder,
            Self::Installed => folder.join(processor.name),
            Self::FromSource { .. } => folder.join("from_source").join(processor.name),
        }
    }

    /// `cargo <command>` for a processor by the profile `release`, in the folder of the manifest (a whole
    /// path), to be given further arguments.
    pub fn cargo(&self, command: &str, manifest: &Path, processor: &Processor) -> Command {
        let mut cargo = match self {
            // The default one, not the one that runs this program: that may be another's.
            Self::Installed => Command::new("cargo"),
            Self::FromSource { cargo, rustc } => {
                let mut command = Command::new(cargo);
                command.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", rustc);
                // Set for the programs that rustup starts, this one among them.
                command.env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO");
                command
            }
        };
        // These flags take the place of all others, those of the package's settings too.
        let flags = processor
            .target_cpu
            .map(|name| format!("-Ctarget-cpu={name}"));
        cargo.env("CARGO_ENCODED_RUSTFLAGS", flags.unwrap_or_default());
        cargo.env_remove("RUSTFLAGS").env_remove("CARGO_TARGET_DIR");
        cargo.current_dir(manifest.parent().unwrap_or(manifest));
        cargo.arg(command).arg("--manifest-path").arg(manifest);
        cargo.args(["--target", processor.target, "--profile", "release"]);
        if matches!(self, Self::FromSource { .. }) {
            cargo.arg("-Zbuild-std=core");
        }
        cargo
    }
}

/// The folder a compiler has its libraries in; none when there is no such compiler.
fn sysroot(rustc: &Path) -> Option<PathBuf> {
    let mut command = Command::new(rustc);
    command.args(["--print", "sysroot"]);
    let printed = output_of(command, "rustc --print sysroot").ok()?;
    Some(printed.trim().into())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::TargetToolchain;
    use crate::processor::{CORTEX_M4F, CORTEX_M7, CORTEX_M33};

    #[test]
    fn a_compiler_is_found_with_the_library_of_the_target_or_with_its_source() {
        let folder = tempfile::tempdir().unwrap();
        let (default, system) = (folder.path().join("default"), folder.path().join("usr"));
        let bin = system.join("bin");
        let installed = |target| TargetToolchain::installed_in(&default, target);
        let from_source = || TargetToolchain::from_source_in(&bin, &system);

        assert_eq!(installed(CORTEX_M7.target), None);
        fs::create_dir_all(default.join("lib/rustlib").join(CORTEX_M7.target)).unwrap();
        assert_eq!(
            installed(CORTEX_M7.target),
            Some(TargetToolchain::Installed)
        );
        assert_eq!(
            installed(CORTEX_M33.target),
            None,
            "another target's library"
        );

        fs::create_dir_all(&bin).unwrap();
        for program in ["cargo", "rustc"] {
            fs::write(bin.join(program), "").unwrap();
        }
        assert_eq!(from_source(), None, "no source of the library");
        let core = system.join("lib/rustlib/src/rust/library/core");
        fs::create_dir_all(&core).unwrap();
        fs::write(core.join("Cargo.toml"), "").unwrap();
        let (cargo, rustc) = (bin.join("cargo"), bin.join("rustc"));
        assert_eq!(
            from_source(),
            Some(TargetToolchain::FromSource { cargo, rustc })
        );
    }

    #[test]
    fn what_nothing_compiles_for_is_refused_with_the_command_that_helps() {
        let refusal = TargetToolchain::find("no-such-target").unwrap_err();
        assert!(
            refusal.contains("rustup target add no-such-target"),
            "{refusal}"
        );
    }

    #[test]
    fn only_a_build_from_source_asks_for_unstable_options() {
        let line = |toolchain: &TargetToolchain, processor| {
            let command = toolchain.cargo("build", "some/Cargo.toml".as_ref(), processor);
            format!("{command:?}")
        };
        let installed = line(&TargetToolchain::Installed, &CORTEX_M7);
        assert!(!installed.contains("-Zbuild-std"), "{installed}");
        assert!(!installed.contains("RUSTC_BOOTSTRAP"), "{installed}");
        assert!(installed.contains("target-cpu=cortex-m7"), "{installed}");
        let from_source = line(
            &TargetToolchain::FromSource {
                cargo: "/usr/bin/cargo".into(),
                rustc: "/usr/bin/rustc".into(),
            },
            &CORTEX_M4F,
        );
        assert!(from_source.contains("-Zbuild-std=core"), "{from_source}");
        assert!(from_source.contains("RUSTC_BOOTSTRAP"), "{from_source}");
        assert!(!from_source.contains("target-cpu"), "{from_source}");
    }
}
