//! FMUs: a damper, a bank of them, or a vehicle around dampers behind the Functional Mock-up Interface 2.0 or 3.0, for co-simulation.
//!
//! `sources/` is the interface in C, over the step of `standalone/` or over a library; `headers/` are the official headers of the
//! interface (Modelica Association, BSD 2-Clause). Constants are compiled in, or lie as images in the folder of resources.

mod archive;
mod bank;
mod binary;
mod description;
mod machine;
mod page;
mod sources;
mod variable;
mod vehicle;

use std::path::PathBuf;

use maud::Markup;
use sha2::{Digest, Sha256};

pub use archive::archive;
pub use bank::Named;
pub use binary::{Binary, CompileError, compile};
pub use machine::Machine;

use super::{ExportError, name};
use sources::Source;
use variable::Variable;

/// Version of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Interface {
    /// Its number.
    pub fn number(self) -> &'static str {
        match self {
            Self::Two => "2.0",
            Self::Three => "3.0",
        }
    }
}

/// What an FMU is made of.
pub struct Fmu {
    interface: Interface,
    identifier: String,
    token: String,
    /// What it is, in a line.
    title: String,
    step_s: f64,
    stop_s: f64,
    variables: Vec<Variable>,
    /// Whether derivatives of inputs are taken.
    has_input_derivatives: bool,
    /// Whether a run may end within a step.
    may_end: bool,
    /// Paragraphs of its page.
    about: Markup,
    /// Files in the folder of resources.
    resources: Vec<(String, Vec<u8>)>,
    sources: Vec<Source>,
    /// What the sources are linked with. An importer has no use for sources that need more than themselves.
    library: Option<PathBuf>,
}

impl Fmu {
    /// Tells this FMU from others, as a UUID is written.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// What its functions begin with.
    pub fn identifier(&self) -> &str {
        &self.identifier
    }

    /// Version of the interface.
    pub fn interface(&self) -> Interface {
        self.interface
    }

    /// Internal step, s.
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Whether an importer may compile its sources.
    pub fn has_sources(&self) -> bool {
        self.library.is_none()
    }
}

/// Functions that begin with `identifier` need one of ASCII letters, digits and `_`.
fn check(identifier: &str) -> Result<(), ExportError> {
    name::check_c(&identifier.to_ascii_uppercase())
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The hash of what an FMU is made of, as a UUID is written.
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
    let hash = hexadecimal(&hash.finalize());
    let parts = [
        &hash[..8],
        &hash[8..12],
        &hash[12..16],
        &hash[16..20],
        &hash[20..32],
    ];
    format!("{{{}}}", parts.join("-"))
}
