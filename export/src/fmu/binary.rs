//! The library of an FMU for the platform it is exported on, by the C compiler that is there.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use super::{Fmu, Interface, Machine};

/// A compiled FMU.
#[derive(Debug)]
pub struct Binary {
    /// Folder of the platform.
    pub platform: String,
    /// End of the library's name.
    pub end: &'static str,
    /// The library.
    pub content: Vec<u8>,
}

/// Why there is no library.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompileError {
    /// The compiler is not there.
    #[error(
        "the C compiler {compiler} cannot be started ({source}); allowed: another one by the variable CC, or no library for this platform with --sources-only"
    )]
    Missing {
        /// Its name.
        compiler: String,
        /// Why.
        source: io::Error,
    },
    /// The compiler refuses the sources.
    #[error(
        "the C compiler {compiler} failed: {message}\nallowed: another one by the variable CC, or no library for this platform with --sources-only"
    )]
    Failed {
        /// Its name.
        compiler: String,
        /// What it said.
        message: String,
    },
    /// A platform that this version of the interface has no name for.
    #[error("FMI 2 has no folder for a library of {platform}, allowed: --fmi 3, or --sources-only")]
    Platform {
        /// The platform.
        platform: String,
    },
    /// The compiler built a library for another platform.
    #[error(
        "the C compiler {compiler} built {}, needed for {platform}: {needed}; allowed: a compiler for this platform \
         by the variable CC, or no library with --sources-only",
        described(.found.as_ref())
    )]
    OtherMachine {
        /// Its name.
        compiler: String,
        /// What it built; `None` where the file has no header of a library.
        found: Option<Machine>,
        /// Folder of the platform.
        platform: String,
        /// What that platform loads.
        needed: Machine,
    },
    /// The library of vehicles is of another platform.
    #[error(
        "{}: the library of vehicles holds object files of another kind ({found}), needed for {platform}: {needed}; \
         allowed: --library FILE with one built for this platform",
        library.display()
    )]
    OtherLibrary {
        /// The library.
        library: PathBuf,
        /// What its object files are.
        found: Machine,
        /// Folder of the platform.
        platform: String,
        /// What that platform loads.
        needed: Machine,
    },
    /// No place for what the compiler reads and writes.
    #[error("a temporary folder: {0}")]
    Folder(#[from] io::Error),
}

/// What a library of Rust is linked with; only the functions of the interface are seen from outside, and nothing is left that they do not
/// use.
#[cfg(target_os = "linux")]
const BESIDE_A_LIBRARY: [&str; 6] = [
    "-Wl,--exclude-libs,ALL",
    "-Wl,--gc-sections",
    "-Wl,--strip-all",
    "-static-libgcc",
    "-lpthread",
    "-ldl",
];
#[cfg(not(target_os = "linux"))]
const BESIDE_A_LIBRARY: [&str; 0] = [];

/// What a file holds.
fn described(found: Option<&Machine>) -> String {
    found.map_or_else(
        || "no library of a known form".into(),
        |machine| format!("a file of another kind ({machine})"),
    )
}

/// Compiles an FMU for this platform, with the compiler that the variable `CC` names, or `cc`.
///
/// # Errors
/// There is no compiler, it fails, it builds for another platform, or the platform has no name.
pub fn compile(fmu: &Fmu) -> Result<Binary, CompileError> {
    let platform = platform(fmu.interface)?;
    let needed = Machine::here();
    if let Some(library) = &fmu.library {
        let found = Machine::of_archive(&std::fs::read(library)?);
        // What is no archive of a known form is left to the linker.
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
    let end = env::consts::DLL_EXTENSION;
    let folder = tempfile::tempdir()?;
    for (name, text) in &fmu.sources {
        std::fs::write(folder.path().join(name), text)?;
    }
    for (name, text) in fmu.headers() {
        std::fs::write(folder.path().join(name), text)?;
    }
    let (compiler, options) = compiler(&env::var("CC").unwrap_or_default());
    let library = folder.path().join(format!("library.{end}"));
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
        command.args(BESIDE_A_LIBRARY);
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
        end,
        content,
    })
}

/// A compiler and options of it, as the variable `CC` names them: a path may have spaces.
fn compiler(named: &str) -> (String, Vec<String>) {
    let mut words = named.split_whitespace().map(str::to_owned);
    match words.next() {
        None => ("cc".to_owned(), Vec::new()),
        Some(_) if Path::new(named).is_file() => (named.to_owned(), Vec::new()),
        Some(first) => (first, words.collect()),
    }
}

/// The folder of this platform's libraries, FMI 3.0, 2.5.1.4.1 and FMI 2.0.4, 2.3.
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
