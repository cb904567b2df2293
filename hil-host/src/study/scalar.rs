//! The scalars that the step runs in, and their names.

use std::fmt;

use dashpot_core::Real;
use serde::Serialize;

/// A scalar that the step runs in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Scalar {
    /// Single precision, as on the target.
    #[default]
    F32,
    /// Double precision.
    F64,
}

impl Scalar {
    /// Its name, as in Rust.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A type that is a [`Scalar`].
pub trait NamedScalar: Real {
    /// Which one.
    const SCALAR: Scalar;
}

impl NamedScalar for f32 {
    const SCALAR: Scalar = Scalar::F32;
}

impl NamedScalar for f64 {
    const SCALAR: Scalar = Scalar::F64;
}
