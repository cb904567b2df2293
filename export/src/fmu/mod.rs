//! FMUs for co-simulation (Functional Mock-up Interface 2.0 or 3.0): a damper, a bank of dampers, or a vehicle.
//!
//! `sources/` implements the interface in C, on top of the step of `standalone/` or of a library. `headers/` contains
//! the official headers (Modelica Association, BSD 2-Clause). The constants are compiled in, or are images in the
//! resources folder.

mod archive;
mod bank;
mod binary;
mod description;
mod machine;
mod page;
mod platform;
mod sources;
mod system;
mod terminals;
mod variable;
mod vehicle;
mod xml;

use std::path::PathBuf;

use maud::Markup;
use sha2::{Digest, Sha256};

pub use archive::archive;
pub use bank::NamedDamper;
pub use binary::{Binary, CompileError, Remedy, Target, compile};
pub use machine::Machine;
pub use platform::{Platform, UnknownPlatform};
pub use system::{Part, system};

use super::{ExportError, name};
use sources::Source;
use terminals::Terminal;
use variable::Variable;

/// Version of the FMI standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Interface {
    /// Version number.
    pub fn number(self) -> &'static str {
        match self {
            Self::Two => "2.0",
            Self::Three => "3.0",
        }
    }
}

/// Content of an FMU.
pub struct Fmu {
    interface: Interface,
    identifier: String,
    token: String,
    /// One-line description.
    title: String,
    step_s: f64,
    stop_s: f64,
    variables: Vec<Variable>,
    terminals: Vec<Terminal>,
    /// True if the FMU accepts derivatives of inputs.
    has_input_derivatives: bool,
    /// True if a run may end within a communication step.
    may_end: bool,
    /// Paragraphs of the documentation page.
    about: Markup,
    /// Name and content of the files in the resources folder.
    resources: Vec<(String, Vec<u8>)>,
    sources: Vec<Source>,
    /// Libraries to link with the sources, one for each platform. An FMU with libraries contains no sources, because
    /// an importer does not have them.
    libraries: Vec<(Platform, PathBuf)>,
}

impl Fmu {
    /// Unique identifier of this FMU's content, in the form of a UUID.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Prefix of the FMU's functions.
    pub fn identifier(&self) -> &str {
        &self.identifier
    }

    /// Version of the FMI standard.
    pub fn interface(&self) -> Interface {
        self.interface
    }

    /// Internal step (s).
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// True if the FMU contains sources that an importer can compile.
    pub fn has_sources(&self) -> bool {
        self.libraries.is_empty()
    }
}

/// Checks that `identifier`, the prefix of C functions, consists of ASCII letters, digits and `_`.
fn check(identifier: &str) -> Result<(), ExportError> {
    name::check_c(&identifier.to_ascii_uppercase())
}

/// Hash of an FMU's content, in the form of a UUID.
fn token_of<'a>(
    identifier: &str,
    interface: Interface,
    parts: impl IntoIterator<Item = &'a [u8]>,
) -> String {
    let mut hash = Sha256::new();
    hash.update(env!("CARGO_PKG_VERSION"));
    hash.update(identifier);
    hash.update([interface as u8]);
    for part in parts {
        hash.update(part);
    }
    let hash = dashpot_files::hexadecimal(&hash.finalize());
    let parts = [
        &hash[..8],
        &hash[8..12],
        &hash[12..16],
        &hash[16..20],
        &hash[20..32],
    ];
    format!("{{{}}}", parts.join("-"))
}
