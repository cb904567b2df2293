//! Platforms of the libraries in an FMU.

use std::env;
use std::fmt;
use std::str::FromStr;

use super::{Interface, Machine};

/// Processor and system, with the names of FMI 3 (section 2.5.1.4.1): `x86_64-linux`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Platform {
    processor: String,
    system: String,
}

/// Processors: name of FMI 3, and the name in `std::env::consts::ARCH`.
const PROCESSORS: [(&str, &str); 6] = [
    ("x86_64", "x86_64"),
    ("x86", "x86"),
    ("aarch64", "aarch64"),
    ("aarch32", "arm"),
    ("riscv64", "riscv64"),
    ("riscv32", "riscv32"),
];

/// Systems: name of FMI 3, extension of a library, name in FMI 2 (section 2.3).
const SYSTEMS: [(&str, &str, &str); 3] = [
    ("linux", "so", "linux"),
    ("windows", "dll", "win"),
    ("darwin", "dylib", "darwin"),
];

impl Platform {
    /// The platform of this program.
    pub fn here() -> Self {
        let processor = PROCESSORS
            .iter()
            .find(|(_, name)| *name == env::consts::ARCH);
        let system = if env::consts::OS == "macos" {
            "darwin"
        } else {
            env::consts::OS
        };
        Self {
            processor: processor
                .map_or(env::consts::ARCH, |(name, _)| name)
                .to_owned(),
            system: system.to_owned(),
        }
    }

    /// Type of shared library that programs of the platform load.
    pub fn machine(&self) -> Machine {
        let processor = PROCESSORS.iter().find(|(name, _)| *name == self.processor);
        match processor {
            Some((_, processor)) => Machine::shared(processor, &self.system),
            None => Machine::here(),
        }
    }

    /// Extension of a library's file name, without the dot.
    pub fn extension(&self) -> &'static str {
        let system = SYSTEMS.iter().find(|(name, ..)| *name == self.system);
        system.map_or(env::consts::DLL_EXTENSION, |(_, extension, _)| extension)
    }

    /// Name of the platform's folder in an FMU; `None` if FMI 2 has none.
    pub(super) fn folder(&self, interface: Interface) -> Option<String> {
        let bits = match (interface, &*self.processor) {
            (Interface::Three, _) => return Some(self.to_string()),
            (Interface::Two, "x86_64") => 64,
            (Interface::Two, "x86") => 32,
            (Interface::Two, _) => return None,
        };
        let system = SYSTEMS.iter().find(|(name, ..)| *name == self.system);
        Some(format!(
            "{}{bits}",
            system.map_or(&*self.system, |(_, _, short)| short)
        ))
    }

    /// True if libraries of the platform are those of Windows.
    pub(super) fn is_windows(&self) -> bool {
        self.system == "windows"
    }

    /// True if libraries of the platform are those of Linux.
    pub(super) fn is_linux(&self) -> bool {
        self.system == "linux"
    }
}

impl fmt::Display for Platform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}", self.processor, self.system)
    }
}

/// Why a text is no platform.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown platform {text}; allowed: {}", allowed())]
pub struct UnknownPlatform {
    /// The text.
    pub text: String,
}

fn allowed() -> String {
    let processors = PROCESSORS.map(|(name, _)| name).join(", ");
    let systems = SYSTEMS.map(|(name, ..)| name).join(", ");
    format!("a processor ({processors}), a hyphen and a system ({systems})")
}

impl FromStr for Platform {
    type Err = UnknownPlatform;

    /// Reads a name such as `x86_64-windows`.
    ///
    /// ```
    /// use dashpot_export::fmu::Platform;
    /// let windows: Platform = "x86_64-windows".parse()?;
    /// assert_eq!((windows.extension(), windows.to_string()), ("dll", "x86_64-windows".into()));
    /// assert!("win64".parse::<Platform>().is_err());
    /// # Ok::<(), dashpot_export::fmu::UnknownPlatform>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, UnknownPlatform> {
        let known = text.split_once('-').filter(|(processor, system)| {
            PROCESSORS.iter().any(|(name, _)| name == processor)
                && SYSTEMS.iter().any(|(name, ..)| name == system)
        });
        match known {
            Some((processor, system)) => Ok(Self {
                processor: processor.to_owned(),
                system: system.to_owned(),
            }),
            None => Err(UnknownPlatform {
                text: text.to_owned(),
            }),
        }
    }
}
