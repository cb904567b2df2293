//! Export errors.

use std::path::PathBuf;

use dashpot_files::Scalar;

/// Prefix of the macros in `dashpot.h` and of the include guards of exported headers.
pub(super) const C_LIBRARY_PREFIX: &str = "DASHPOT_";

/// Suffixes of the macros in `stdint.h`.
pub(super) const RESERVED_SUFFIXES: [&str; 4] = ["_MAX", "_MIN", "_C", "_WIDTH"];

/// Error from an export, with the allowed values.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// Invalid name of a constant.
    #[error("constant {name}: {reason}")]
    Name {
        /// The name.
        name: String,
        /// The problem.
        reason: NameError,
    },
    /// File name that C cannot include.
    #[error(
        "file {file}: C cannot include it, allowed: Unicode without quotation marks, backslashes and control characters"
    )]
    Include {
        /// Name of the file.
        file: String,
    },
    /// Cannot write the case.
    #[error("cannot write the case: {0}")]
    Case(String),
    /// Cannot read the vehicle library.
    #[error("{}: cannot read the vehicle library: {reason}", path.display())]
    Library {
        /// The library.
        path: PathBuf,
        /// Error from the operating system.
        reason: String,
    },
    /// Scalar type that the C library does not support.
    #[error("scalar {scalar}: the C library uses single precision, allowed: f32")]
    Scalar {
        /// The scalar type.
        scalar: Scalar,
    },
}

/// Problem with the name of a constant; the message gives the allowed names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NameError {
    /// Invalid characters.
    #[error("not a valid constant name, allowed: A to Z first, then A to Z, 0 to 9 and _")]
    Invalid,
    /// The C headers reserve the name.
    #[error(
        "reserved by C headers, allowed: names other than NULL that do not start with {C_LIBRARY_PREFIX} or end in {}",
        RESERVED_SUFFIXES.join(", ")
    )]
    Reserved,
}
