//! Floating-point arithmetic of a processor; the bits of a row depend on it.

use std::fmt;

/// How a processor rounds a multiplication followed by an addition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arithmetic {
    /// One rounding: fused multiply-add.
    Fused,
    /// Two roundings, one for each operation.
    Separate,
}

impl fmt::Display for Arithmetic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl Arithmetic {
    /// Arithmetic of this processor.
    pub fn here() -> Self {
        if dashpot_rail::fuses_multiplication() {
            Self::Fused
        } else {
            Self::Separate
        }
    }

    /// Word for this arithmetic in a row.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Fused => "fused",
            Self::Separate => "separate",
        }
    }
}
