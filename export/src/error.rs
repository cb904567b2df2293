//! Why a damper cannot be exported.

use dashpot_files::Scalar;

/// What the macros of `dashpot.h` and the guards of exported headers start with.
pub(super) const C_LIBRARY_PREFIX: &str = "DASHPOT_";

/// How macros of `stdint.h` end.
pub(super) const RESERVED_ENDS: [&str; 4] = ["_MAX", "_MIN", "_C", "_WIDTH"];

/// Why a damper cannot be exported; each says what is allowed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// No name of a constant.
    #[error("name {name}: no name of a constant, allowed: A to Z first, then A to Z, 0 to 9 and _")]
    Name {
        /// The name.
        name: String,
    },
    /// A name that headers of C may define.
    #[error(
        "name {name}: the C headers may define it, allowed: not NULL, no start with {C_LIBRARY_PREFIX}, no end \
         in {}",
        RESERVED_ENDS.join(", ")
    )]
    ReservedName {
        /// The name.
        name: String,
    },
    /// A file's name that C cannot include.
    #[error(
        "file {file}: C cannot include it, allowed: Unicode without \
         quotation mark, backslash and control character"
    )]
    Include {
        /// The name.
        file: String,
    },
    /// A case that cannot be written.
    #[error("the case cannot be written: {0}")]
    Case(String),
    /// A library of vehicles that cannot be read.
    #[error("the library of vehicles {0}")]
    Library(String),
    /// A scalar that the C library does not have.
    #[error("scalar {scalar}: the C library is of single precision, allowed for it: f32")]
    Scalar {
        /// The scalar.
        scalar: Scalar,
    },
}
