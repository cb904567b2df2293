//! Compiles the library of an FMU for a platform with an installed C compiler.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{Fmu, Machine, Platform};

/// Compiled library of an FMU.
#[derive(Debug)]
pub struct Binary {
    /// Name of the platform's folder.
    pub folder: String,
    /// Name of the platform.
    pub platform: String,
    /// Extension of the library's file name.
    pub extension: &'static str,
    /// Content of the library.
    pub content: Vec<u8>,
}

/// Ways to avoid a [`CompileError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Use another C compiler.
    OtherCompiler,
    /// Export sources only, without a library.
    SourcesOnly,
    /// Use FMI 3, which has a folder for every platform.
    Fmi3,
    /// Use a vehicle library that was built for the platform.
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
        /// Name of the platform.
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
        /// Name of the platform.
        platform: String,
        /// Type of library that the platform loads.
        needed: Machine,
    },
    /// There is no vehicle library for the platform.
    #[error("no vehicle library for {platform}")]
    NoLibrary {
        /// Name of the platform.
        platform: String,
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
            Self::OtherLibrary { .. } | Self::NoLibrary { .. } => &[Remedy::OtherLibrary],
            Self::Files(_) => &[],
        }
    }

    /// The error and its remedies, which `in_words` says in the words of the caller.
    pub fn with_remedies(&self, in_words: impl Fn(Remedy) -> String) -> String {
        let remedies: Vec<String> = self.remedies().iter().copied().map(in_words).collect();
        // A compiler's messages may span several lines.
        let separator = match self {
            Self::Failed { .. } => "\n",
            _ => "; ",
        };
        match remedies.is_empty() {
            true => self.to_string(),
            false => format!("{self}{separator}allowed: {}", remedies.join(", or ")),
        }
    }
}

/// Linker options for a Rust library on Linux. Only the functions of the interface stay visible, and unused code is
/// removed.
const LINUX_OPTIONS: [&str; 6] = [
    "-Wl,--exclude-libs,ALL",
    "-Wl,--gc-sections",
    "-Wl,--strip-all",
    "-static-libgcc",
    "-lpthread",
    "-ldl",
];
/// Linker options for a Rust library on Windows, with the system's libraries that it calls.
const WINDOWS_OPTIONS: [&str; 8] = [
    "-Wl,--gc-sections",
    "-Wl,--strip-all",
    "-static-libgcc",
    "-lkernel32",
    "-lntdll",
    "-luserenv",
    "-lws2_32",
    "-ldbghelp",
];

/// A platform and what builds for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The platform.
    pub platform: Platform,
    /// C compiler with options, separated by spaces. If it is empty, `cc`.
    pub compiler: String,
}

impl Target {
    /// This platform, with the compiler in the environment variable `CC`.
    pub fn here() -> Self {
        Self {
            platform: Platform::here(),
            compiler: env::var("CC").unwrap_or_default(),
        }
    }

    /// Puts [`Target::here`] before the given targets unless one of them is for this platform.
    pub fn with_here(mut targets: Vec<Self>) -> Vec<Self> {
        let here = Self::here();
        if targets
            .iter()
            .all(|target| target.platform != here.platform)
        {
            targets.insert(0, here);
        }
        targets
    }
}

/// Describes the type of a file.
fn described(found: Option<&Machine>) -> String {
    found.map_or_else(
        || "a file of unknown type".into(),
        |machine| format!("a file of another type ({machine})"),
    )
}

/// Compiles an FMU for a platform.
///
/// # Errors
/// Returns an error if the compiler is missing, fails or builds for another platform, if the platform has no folder, or
/// if the FMU needs a library that was not given for the platform.
pub fn compile(fmu: &Fmu, target: &Target) -> Result<Binary, CompileError> {
    let platform = &target.platform;
    let folder_name = platform
        .folder(fmu.interface)
        .ok_or_else(|| CompileError::Platform {
            platform: platform.to_string(),
        })?;
    let needed = platform.machine();
    let linked = linked(fmu, platform)?;
    let extension = platform.extension();
    let folder = tempfile::tempdir()?;
    for (name, text) in &fmu.sources {
        std::fs::write(folder.path().join(name), text)?;
    }
    for (name, text) in fmu.headers() {
        std::fs::write(folder.path().join(name), text)?;
    }
    let (compiler, options) = compiler(&target.compiler);
    let library = folder.path().join(format!("library.{extension}"));
    let mut command = Command::new(&compiler);
    command
        .args(options)
        .args([
            "-std=c99",
            "-O2",
            "-shared",
            "-DFMI2_OVERRIDE_FUNCTION_PREFIX",
            "-DFMI3_OVERRIDE_FUNCTION_PREFIX",
            "-o",
        ])
        .arg(&library)
        .args(fmu.compiled());
    match platform.is_windows() {
        true => command.args(["-static-libgcc", "-Wl,--strip-all"]),
        false => command.args(["-fPIC", "-fvisibility=hidden"]),
    };
    if let Some(linked) = linked {
        command.arg(std::path::absolute(linked)?);
        if platform.is_linux() {
            command.args(LINUX_OPTIONS);
        } else if platform.is_windows() {
            command.args(WINDOWS_OPTIONS);
        }
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
            platform: platform.to_string(),
            needed,
        });
    }
    Ok(Binary {
        folder: folder_name,
        platform: platform.to_string(),
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

/// Returns the Rust library of the platform, if the FMU needs one.
fn linked<'a>(fmu: &'a Fmu, platform: &Platform) -> Result<Option<&'a Path>, CompileError> {
    if fmu.has_sources() {
        return Ok(None);
    }
    let mut libraries = fmu.libraries.iter();
    let Some((_, library)) = libraries.find(|(of, _)| of == platform) else {
        return Err(CompileError::NoLibrary {
            platform: platform.to_string(),
        });
    };
    let needed = platform.machine();
    let found = Machine::of_archive(&std::fs::read(library)?);
    // If the type of the archive is unknown, the linker checks it.
    match found.filter(|found| !found.links_into(&needed)) {
        None => Ok(Some(library)),
        Some(found) => Err(CompileError::OtherLibrary {
            library: library.clone(),
            found,
            platform: platform.to_string(),
            needed,
        }),
    }
}
