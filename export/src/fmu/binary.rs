//! Compiles the library of an FMU for this platform with an installed C compiler.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{Fmu, Interface, Machine};

/// Compiled library of an FMU.
#[derive(Debug)]
pub struct Binary {
    /// Name of the platform's folder.
    pub platform: String,
    /// Extension of the library's file name.
    pub extension: &'static str,
    /// Content of the library.
    pub content: Vec<u8>,
}

/// Ways to avoid a [`CompileError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Use another C compiler: [`compile`] reads the environment variable `CC`.
    OtherCompiler,
    /// Export sources only, without a library for this platform.
    SourcesOnly,
    /// Use FMI 3, which has a folder for every platform.
    Fmi3,
    /// Use a vehicle library that was built for this platform.
    OtherLibrary,
}

/// Error from compiling an FMU; [`CompileError::remedies`] lists ways to avoid it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompileError {
    /// Cannot start the compiler.
    #[error("the C compiler {compiler} cannot be started ({source})")]
    Missing {
        /// Name of the compiler.
        compiler: String,
        /// Error from the operating system.
        source: io::Error,
    },
    /// The compiler failed.
    #[error("the C compiler {compiler} failed: {message}")]
    Failed {
        /// Name of the compiler.
        compiler: String,
        /// Exit status and messages of the compiler.
        message: String,
    },
    /// FMI 2 has no folder for this platform.
    #[error("FMI 2 has no folder for a library of {platform}")]
    Platform {
        /// Name of the platform.
        platform: String,
    },
    /// The compiler built a library for another platform.
    #[error("the C compiler {compiler} built {}, but {platform} needs {needed}", described(.found.as_ref()))]
    OtherMachine {
        /// Name of the compiler.
        compiler: String,
        /// Type of the built file; `None` if it has no known header.
        found: Option<Machine>,
        /// Name of the platform's folder.
        platform: String,
        /// Type of library that the platform loads.
        needed: Machine,
    },
    /// The vehicle library is for another platform.
    #[error(
        "{}: the vehicle library contains object files of another type ({found}), but {platform} needs {needed}",
        library.display()
    )]
    OtherLibrary {
        /// The library.
        library: PathBuf,
        /// Type of its object files.
        found: Machine,
        /// Name of the platform's folder.
        platform: String,
        /// Type of library that the platform loads.
        needed: Machine,
    },
    /// Cannot read the vehicle library, or cannot use a temporary folder for the compiler's files.
    #[error("cannot prepare the compilation: {0}")]
    Files(#[from] io::Error),
}

impl CompileError {
    /// Ways to avoid the error, best first.
    pub fn remedies(&self) -> &'static [Remedy] {
        match self {
            Self::Missing { .. } | Self::Failed { .. } | Self::OtherMachine { .. } => {
                &[Remedy::OtherCompiler, Remedy::SourcesOnly]
            }
            Self::Platform { .. } => &[Remedy::Fmi3, Remedy::SourcesOnly],
            Self::OtherLibrary { .. } => &[Remedy::OtherLibrary],
            Self::Files(_) => &[],
        }
    }
}

/// Linker options for a Rust library. Only the functions of the interface stay visible, and unused code is removed.
#[cfg(target_os = "linux")]
const RUST_LIBRARY_OPTIONS: [&str; 6] = [
    "-Wl,--exclude-libs,ALL",
    "-Wl,--gc-sections",
    "-Wl,--strip-all",
    "-static-libgcc",
    "-lpthread",
    "-ldl",
];
#[cfg(not(target_os = "linux"))]
const RUST_LIBRARY_OPTIONS: [&str; 0] = [];

/// Describes the type of a file.
fn described(found: Option<&Machine>) -> String {
    found.map_or_else(
        || "a file of unknown type".into(),
        |machine| format!("a file of another type ({machine})"),
    )
}

/// Compiles an FMU for this platform with the compiler in the environment variable `CC`, or else `cc`.
///
/// # Errors
/// Returns an error if the compiler is missing, fails or builds for another platform, or if the platform has no folder.
pub fn compile(fmu: &Fmu) -> Result<Binary, CompileError> {
    let platform = platform(fmu.interface)?;
    let needed = Machine::here();
    if let Some(library) = &fmu.library {
        let found = Machine::of_archive(&std::fs::read(library)?);
        // If the type of the archive is unknown, the linker checks it.
        if let Some(found) = found.filter(|found| !found.links_into(&needed)) {
            let library = library.clone();
            return Err(CompileError::OtherLibrary {
                library,
                found,
                platform,
                needed,
            });
        }
    }
    let extension = env::consts::DLL_EXTENSION;
    let folder = tempfile::tempdir()?;
    for (name, text) in &fmu.sources {
        std::fs::write(folder.path().join(name), text)?;
    }
    for (name, text) in fmu.headers() {
        std::fs::write(folder.path().join(name), text)?;
    }
    let (compiler, options) = compiler(&env::var("CC").unwrap_or_default());
    let library = folder.path().join(format!("library.{extension}"));
    let mut command = Command::new(&compiler);
    command
        .args(options)
        .args([
            "-std=c99",
            "-O2",
            "-fPIC",
            "-shared",
            "-fvisibility=hidden",
            "-DFMI2_OVERRIDE_FUNCTION_PREFIX",
            "-DFMI3_OVERRIDE_FUNCTION_PREFIX",
            "-o",
        ])
        .arg(&library)
        .args(fmu.compiled());
    if let Some(library) = &fmu.library {
        command.arg(std::path::absolute(library)?);
        command.args(RUST_LIBRARY_OPTIONS);
    }
    command
        .arg("-lm")
        .current_dir(folder.path())
        .stdin(Stdio::null());
    let output = match command.output() {
        Ok(output) => output,
        Err(source) => return Err(CompileError::Missing { compiler, source }),
    };
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr);
        let message = format!("{}\n{}", output.status, message.trim());
        return Err(CompileError::Failed { compiler, message });
    }
    let content = std::fs::read(library)?;
    let found = Machine::of(&content);
    if !found.is_some_and(|found| found.loads_on(&needed)) {
        return Err(CompileError::OtherMachine {
            compiler,
            found,
            platform,
            needed,
        });
    }
    Ok(Binary {
        platform,
        extension,
        content,
    })
}

/// Splits the value of `CC` into compiler and options. A path to an existing file may contain spaces.
fn compiler(cc: &str) -> (String, Vec<String>) {
    let mut words = cc.split_whitespace().map(str::to_owned);
    match words.next() {
        None => ("cc".to_owned(), Vec::new()),
        Some(_) if Path::new(cc).is_file() => (cc.to_owned(), Vec::new()),
        Some(first) => (first, words.collect()),
    }
}

/// Folder for this platform's libraries (FMI 3.0, section 2.5.1.4.1; FMI 2.0.4, section 2.3).
fn platform(interface: Interface) -> Result<String, CompileError> {
    let (processor, system) = (env::consts::ARCH, env::consts::OS);
    let processor = if processor == "arm" {
        "aarch32"
    } else {
        processor
    };
    let system_name = if system == "macos" { "darwin" } else { system };
    match (interface, processor) {
        (Interface::Three, _) => Ok(format!("{processor}-{system_name}")),
        (Interface::Two, "x86_64") => {
            let short = if system == "windows" {
                "win"
            } else {
                system_name
            };
            Ok(format!("{short}64"))
        }
        (Interface::Two, _) => Err(CompileError::Platform {
            platform: format!("{processor}-{system_name}"),
        }),
    }
}
