//! How a processor multiplies and adds.

use std::fmt;

/// How a processor multiplies and adds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arithmetic {
    /// With one rounding.
    Fused,
    /// With a rounding each.
    Separate,
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl Arithmetic {
    /// Of this processor.
    pub fn here() -> Self {
        if dashpot_rail::fuses_multiplication() {
            Self::Fused
        } else {
            Self::Separate
        }
    }

    /// As rows have it.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Fused => "fused",
            Self::Separate => "separate",
        }
    }
}
