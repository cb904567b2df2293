//! Finds what can compile for the target and prepares cargo for it.
//!
//! With rustup, the default compiler once its target library is installed. Without, a distribution's
//! compiler with library source (Debian: rustc-web and rust-web-src), which builds `core` itself.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{Outcome, output_of};

/// Cortex-M7 with hardware floating point, hard-float calls.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// Takes the processor's own instructions: without it `core` has no hardware square root. As a setting
/// it adds to the flags a package's own `.cargo/config.toml` asks for.
const PROCESSOR: &str = "target.thumbv7em-none-eabihf.rustflags=['-Ctarget-cpu=cortex-m7']";

/// What to do where nothing compiles for the target.
pub const INSTALL: &str = "rustup target add thumbv7em-none-eabihf";

/// Where a distribution puts its compiler.
const SYSTEM_BIN: &str = "/usr/bin";
const SYSTEM_SYSROOT: &str = "/usr";

/// Something that compiles for [`TARGET`].
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
    /// The toolchain of this machine.
    ///
    /// # Errors
    /// There is none; the message has the command that installs one.
    pub fn find() -> Outcome<Self> {
        let default = sysroot(Path::new("rustc"));
        Self::among(
            default.as_deref(),
            Path::new(SYSTEM_BIN),
            Path::new(SYSTEM_SYSROOT),
        )
    }

    /// The toolchain, given the default compiler's sysroot and where a distribution's are.
    fn among(default: Option<&Path>, bin: &Path, system: &Path) -> Outcome<Self> {
        if default.is_some_and(|sysroot| sysroot.join("lib/rustlib").join(TARGET).is_dir()) {
            return Ok(Self::Installed);
        }
        let (cargo, rustc) = (bin.join("cargo"), bin.join("rustc"));
        let source = system.join("lib/rustlib/src/rust/library/core/Cargo.toml");
        if cargo.exists() && rustc.exists() && source.exists() {
            return Ok(Self::FromSource { cargo, rustc });
        }
        Err(format!(
            "nothing here compiles for {TARGET}: run `{INSTALL}`"
        ))
    }

    /// `cargo <command> --target thumbv7em-none-eabihf --profile <profile>` in the folder of the
    /// manifest (a whole path), to be given further arguments.
    pub fn cargo(&self, command: &str, manifest: &Path, profile: &str) -> Command {
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
        // Flags in the environment would replace those of the settings.
        cargo
            .env_remove("RUSTFLAGS")
            .env_remove("CARGO_ENCODED_RUSTFLAGS");
        cargo.current_dir(manifest.parent().unwrap_or(manifest));
        cargo.arg(command).arg("--manifest-path").arg(manifest);
        cargo.args([
            "--target",
            TARGET,
            "--profile",
            profile,
            "--config",
            PROCESSOR,
        ]);
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
    use super::{TARGET, TargetToolchain};
    use std::fs;

    #[test]
    fn the_default_compiler_comes_first_then_a_distributions_then_advice() {
        let folder = tempfile::tempdir().unwrap();
        let (default, system) = (folder.path().join("default"), folder.path().join("usr"));
        let bin = system.join("bin");
        let find = || TargetToolchain::among(Some(&default), &bin, &system);
        let refusal = find().unwrap_err();
        assert!(
            refusal.contains("rustup target add thumbv7em-none-eabihf"),
            "{refusal}"
        );

        fs::create_dir_all(&bin).unwrap();
        for program in ["cargo", "rustc"] {
            fs::write(bin.join(program), "").unwrap();
        }
        assert!(
            find().is_err(),
            "a compiler without library source builds nothing"
        );
        let core = system.join("lib/rustlib/src/rust/library/core");
        fs::create_dir_all(&core).unwrap();
        fs::write(core.join("Cargo.toml"), "").unwrap();
        let (cargo, rustc) = (bin.join("cargo"), bin.join("rustc"));
        assert_eq!(find(), Ok(TargetToolchain::FromSource { cargo, rustc }));

        fs::create_dir_all(default.join("lib/rustlib").join(TARGET)).unwrap();
        assert_eq!(find(), Ok(TargetToolchain::Installed));
    }

    #[test]
    fn only_a_build_from_source_asks_for_unstable_options() {
        let line = |toolchain: TargetToolchain| {
            format!(
                "{:?}",
                toolchain.cargo("build", "some/Cargo.toml".as_ref(), "release")
            )
        };
        let installed = line(TargetToolchain::Installed);
        assert!(!installed.contains("-Zbuild-std"), "{installed}");
        assert!(!installed.contains("RUSTC_BOOTSTRAP"), "{installed}");
        let from_source = line(TargetToolchain::FromSource {
            cargo: "/usr/bin/cargo".into(),
            rustc: "/usr/bin/rustc".into(),
        });
        assert!(from_source.contains("-Zbuild-std=core"), "{from_source}");
        assert!(from_source.contains("RUSTC_BOOTSTRAP"), "{from_source}");
    }
}
