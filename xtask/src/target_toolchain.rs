//! Finds a compiler for a processor and prepares cargo for it.
//!
//! The first choice is the default compiler, if it has the target's library from rustup. The second is a distribution's
//! compiler with the library's source (Debian's rustc-web and rust-web-src), which compiles `core` itself.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::processor::{CORTEX_M7, Processor};
use crate::run::{Outcome, output_of};

/// Folder of a distribution's compiler.
const SYSTEM_BIN: &str = "/usr/bin";
const SYSTEM_SYSROOT: &str = "/usr";

/// A compiler for a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TargetToolchain {
    /// The default compiler, with the target's library.
    Installed,
    /// A compiler that compiles `core` from source first.
    FromSource {
        /// Path of cargo.
        cargo: PathBuf,
        /// Path of rustc.
        rustc: PathBuf,
    },
}

impl TargetToolchain {
    /// Returns the compiler that this machine uses for a target: the first choice that it has. A distribution's
    /// compiler serves only targets without an operating system, because it compiles only `core`.
    ///
    /// # Errors
    /// There is no such compiler. The message contains the command that installs one.
    pub fn find(target: &str) -> Outcome<Self> {
        Self::installed(target)
            .or_else(|| Self::distribution().filter(|_| target.contains("-none-")))
            .ok_or_else(|| {
                format!("no compiler here supports {target}: run `rustup target add {target}`")
            })
    }

    /// Returns the default compiler if it has the target's library.
    pub fn installed(target: &str) -> Option<Self> {
        Self::installed_in(&sysroot(Path::new("rustc"))?, target)
    }

    /// Returns a distribution's compiler if it has the library's source.
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

    /// Returns the compiler's name and version as it prints them.
    ///
    /// # Errors
    /// The compiler does not run.
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

    /// Returns the folder for builds of the package in the folder `package`. Each compiler and processor has its own
    /// folder; the first choice of compiler with a Cortex-M7 has cargo's usual one.
    pub fn output_folder(&self, package: &Path, processor: &Processor) -> PathBuf {
        let folder = package.join("target");
        let first = Self::find(processor.target).is_ok_and(|first| first == *self);
        match self {
            _ if first && *processor == CORTEX_M7 => folder,
            Self::Installed => folder.join(processor.name),
            Self::FromSource { .. } => folder.join("from_source").join(processor.name),
        }
    }

    /// Returns `cargo <command>` for a processor with the profile `release`, in the folder of the manifest (an absolute
    /// path). The caller adds arguments.
    pub fn cargo(&self, command: &str, manifest: &Path, processor: &Processor) -> Command {
        let mut cargo = match self {
            // Use the default cargo, because another toolchain's cargo may have started this program.
            Self::Installed => Command::new("cargo"),
            Self::FromSource { cargo, rustc } => {
                let mut command = Command::new(cargo);
                command.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", rustc);
                // rustup sets these variables for the programs it starts, such as this one.
                command.env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO");
                command
            }
        };
        // These flags replace all others, including those in the package's settings.
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

/// Returns the folder of a compiler's libraries; `None` if the compiler does not run.
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
    fn a_compiler_needs_the_target_s_library_or_its_source() {
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
    fn an_unsupported_target_is_refused_with_the_command_that_installs_it() {
        let refusal = TargetToolchain::find("no-such-target").unwrap_err();
        assert!(
            refusal.contains("rustup target add no-such-target"),
            "{refusal}"
        );
    }

    #[test]
    fn only_a_build_from_source_uses_unstable_options() {
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
