//! Scalar types of the damper step, by name.

use std::fmt;

use dashpot_core::Real;
use serde::Serialize;

/// Scalar type of the damper step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scalar {
    /// Single precision, as in firmware.
    #[default]
    F32,
    /// Double precision.
    F64,
}

impl Scalar {
    /// Returns the scalar type that a Rust type stands for.
    pub fn of<T: Real>() -> Self {
        if T::NAME == <f32 as Real>::NAME {
            Self::F32
        } else {
            Self::F64
        }
    }

    /// Name of the type in Rust.
    pub const fn name(self) -> &'static str {
        match self {
            Self::F32 => <f32 as Real>::NAME,
            Self::F64 => <f64 as Real>::NAME,
        }
    }
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
