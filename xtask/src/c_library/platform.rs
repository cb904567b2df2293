//! Platforms of the C library.

use std::env::consts::{ARCH, OS};
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{INTERFACE, archive_in, build, build_from, folder};
use crate::aarch64;
use crate::processor::{AARCH64, CORTEX_M4F, CORTEX_M7, CORTEX_M33, Processor};
use crate::run::Outcome;
use crate::target_toolchain::TargetToolchain;
use crate::tools::{AARCH64_GCC, AARCH64_LIBC, missing};

/// A processor with or without an operating system (Linux).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Platform {
    /// Without an operating system: a static library.
    Bare(Processor),
    /// Linux: a static and a shared library. The text is Rust's name of the processor.
    Linux(&'static str),
}

/// Files that a build creates.
pub struct Built {
    /// The static library.
    pub archive: PathBuf,
    /// The shared library; `None` for a bare processor.
    pub shared: Option<PathBuf>,
}

impl Platform {
    /// List of all platforms.
    pub const ALL: [Self; 5] = [
        Self::Bare(CORTEX_M4F),
        Self::Bare(CORTEX_M7),
        Self::Bare(CORTEX_M33),
        Self::Linux("x86_64"),
        Self::Linux("aarch64"),
    ];

    /// Returns the name in options, folders and files.
    pub fn name(&self) -> String {
        match self {
            Self::Bare(processor) => processor.name.replace('_', "-"),
            Self::Linux(processor) => processor.replace('_', "-"),
        }
    }

    /// True if this machine has this platform.
    pub fn is_host(&self) -> bool {
        matches!(self, Self::Linux(processor) if OS == "linux" && *processor == ARCH)
    }

    /// Returns the library's name: `dashpot` for this machine's own platform. For others it includes the platform, so
    /// that a wrong library is not linked by mistake.
    pub fn library(&self) -> String {
        if self.is_host() {
            "dashpot".into()
        } else {
            format!("dashpot-{}", self.name())
        }
    }

    /// Returns the size of a pointer in bytes.
    pub fn pointer_bytes(&self) -> usize {
        match self {
            Self::Bare(_) => 4,
            Self::Linux(_) => 8,
        }
    }

    /// Checks that this machine can build for the platform.
    ///
    /// # Errors
    /// This machine cannot build for it. The message states what to install.
    pub fn check_tools(&self) -> Outcome {
        match self {
            Self::Bare(processor) => TargetToolchain::find(processor.target).map(drop),
            _ if self.is_host() => Ok(()),
            Self::Linux("aarch64") => {
                TargetToolchain::find(AARCH64)?;
                match missing(&[AARCH64_GCC, AARCH64_LIBC])[..] {
                    [] => Ok(()),
                    ref packages => Err(format!("run `apt-get install {}`", packages.join(" "))),
                }
            }
            Self::Linux(processor) => Err(format!(
                "only a Linux machine with a {processor} processor builds it"
            )),
        }
    }

    /// Builds the libraries from a manifest. Its path is part of the names of symbols.
    ///
    /// # Errors
    /// A tool is missing, or the build fails. The message contains cargo's output.
    pub fn build(&self, manifest: &Path) -> Outcome<Built> {
        self.check_tools()?;
        let (cargo, release) = match self {
            Self::Bare(processor) => {
                let toolchain = TargetToolchain::find(processor.target)?;
                let archive = build_from(manifest, &toolchain, processor)?;
                return Ok(Built {
                    archive,
                    shared: None,
                });
            }
            _ if self.is_host() => {
                let target = folder().join("target");
                let name = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
                let mut cargo = Command::new(name);
                cargo.args(["rustc", "--target-dir"]).arg(&target);
                (cargo, target.join("release"))
            }
            Self::Linux(_) => (aarch64::cargo("rustc"), aarch64::release("")),
        };
        let mut cargo = cargo;
        cargo.arg("--release").arg("--manifest-path").arg(manifest);
        let soname = format!("-Wl,-soname,lib{}.so.{INTERFACE}", self.library());
        // Functions that the compiler adds call memset of the C library, which Rust links only together with std.
        build(cargo, "staticlib,cdylib", &[soname, "-lc".into()])?;
        Ok(Built {
            archive: archive_in(&release),
            shared: Some(release.join("libdashpot.so")),
        })
    }
}
