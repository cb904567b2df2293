//! Scalar types of the damper step, by name.

use std::fmt;
use std::str::FromStr;

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
    /// Both scalars.
    pub const ALL: [Self; 2] = [Self::F32, Self::F64];

    /// Returns the scalar for a Rust type.
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

/// Unknown scalar name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no scalar `{0}`, allowed: f32, f64")]
pub struct UnknownScalar(String);

impl FromStr for Scalar {
    type Err = UnknownScalar;

    fn from_str(name: &str) -> Result<Self, UnknownScalar> {
        Self::ALL
            .into_iter()
            .find(|scalar| scalar.name() == name)
            .ok_or_else(|| UnknownScalar(name.to_owned()))
    }
}
