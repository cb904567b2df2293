//! A damper or a bank of them as an FMU: the portable C behind the Functional Mock-up Interface 2.0 or 3.0, for co-simulation.
//!
//! `sources/` is the interface in C over the step of `standalone/`, `headers/` are the official headers of the interface (Modelica
//! Association, BSD 2-Clause). Constants are compiled in, or lie as images in the folder of resources.

mod archive;
mod binary;
mod description;
mod page;
mod sources;

use dashpot_core::Damper;
use sha2::{Digest, Sha256};

pub use archive::archive;
pub use binary::{Binary, CompileError, compile};

use super::{ExportError, Word, name};

/// Version of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

/// What an FMU is made of.
pub struct Fmu<T> {
    interface: Interface,
    identifier: String,
    dampers: Vec<Named<T>>,
    step_s: f64,
    is_loaded: bool,
}

/// A damper and where it came from.
pub struct Named<T> {
    /// Preset or file.
    pub name: String,
    /// As built.
    pub damper: Damper<T>,
    /// Clearance 2a as its file has it (m).
    pub clearance_m: f64,
}

impl<T: Word> Fmu<T> {
    /// An FMU whose functions begin with `identifier`, of ASCII letters, digits and `_`; all dampers are built for the step `step_s` (s). `is_loaded`: the constants are
    /// images in the folder of resources, which may be replaced.
    ///
    /// # Errors
    /// The identifier in capitals is no name of a constant of C.
    pub fn new(
        interface: Interface,
        identifier: &str,
        dampers: Vec<Named<T>>,
        step_s: f64,
        is_loaded: bool,
    ) -> Result<Self, ExportError> {
        name::check_c(&identifier.to_ascii_uppercase())?;
        Ok(Self {
            interface,
            identifier: identifier.to_owned(),
            dampers,
            step_s,
            is_loaded,
        })
    }

    /// Tells this FMU from others: the hash of its constants and of what they are behind, as a UUID is written.
    pub fn token(&self) -> String {
        let mut hash = Sha256::new();
        hash.update(env!("CARGO_PKG_VERSION"));
        hash.update(&self.identifier);
        hash.update([self.interface as u8, u8::from(self.is_loaded)]);
        for named in &self.dampers {
            hash.update(T::image(&named.damper));
        }
        let hash: String = hash
            .finalize()
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let parts = [
            &hash[..8],
            &hash[8..12],
            &hash[12..16],
            &hash[16..20],
            &hash[20..32],
        ];
        format!("{{{}}}", parts.join("-"))
    }
}
