//! Mirrors the axes of a file.

use std::str::FromStr;

use super::row::Row;

/// Axes of a file whose signs are reversed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mirror {
    /// No axis.
    #[default]
    None,
    /// The lateral axis, for a profile of the other side.
    Y,
    /// The vertical axis, for a profile that is upside down.
    Z,
    /// Both axes, for a profile rotated by 180 degrees.
    Yz,
}

/// The name does not denote a [`Mirror`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}: unknown axes, allowed: none, y, z, yz")]
pub struct UnknownMirror(String);

impl Mirror {
    /// All variants.
    pub const ALL: [Self; 4] = [Self::None, Self::Y, Self::Z, Self::Yz];

    /// Name in lower case, as parsed by `FromStr`.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Y => "y",
            Self::Z => "z",
            Self::Yz => "yz",
        }
    }

    pub(super) fn apply(self, rows: &mut [Row]) {
        for row in rows {
            if matches!(self, Self::Y | Self::Yz) {
                row.y_mm = -row.y_mm;
            }
            if matches!(self, Self::Z | Self::Yz) {
                row.z_mm = -row.z_mm;
            }
        }
    }
}

impl FromStr for Mirror {
    type Err = UnknownMirror;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|mirror| mirror.name() == name);
        known.ok_or_else(|| UnknownMirror(name.to_owned()))
    }
}

/// The points of a file in the axes of a profile.
pub(super) struct OrientedRows {
    pub rows: Vec<Row>,
    /// True if the reader rotated the profile by 180 degrees.
    pub turned: bool,
}
