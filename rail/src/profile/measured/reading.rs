//! What a reader is told, and what it tells of a file beside the profile.

use std::fmt;
use std::str::FromStr;

use super::row::Row;
use super::{DEFAULT_SMOOTHING_M, Format};

/// How a file is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Format of the file; `None`: by its content and the extension of its name.
    pub format: Option<Format>,
    /// Axes of the file whose sign is changed before anything else; `None`: none of them, and for a GENSYS rail an error.
    pub mirror: Option<Mirror>,
    /// Wavelength whose amplitude the smoothing halves, m: [`Profile::through`](crate::profile::Profile::through).
    pub smoothing_m: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            format: None,
            mirror: None,
            smoothing_m: DEFAULT_SMOOTHING_M,
        }
    }
}

/// Axes of a file whose sign is changed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mirror {
    /// No axis.
    #[default]
    None,
    /// The lateral axis: a profile of the other side.
    Y,
    /// The vertical axis: a profile with its vertical axis the other way.
    Z,
    /// Both axes: a profile turned by half a turn.
    Yz,
}

/// A name that is no [`Mirror`]'s.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}: no such axes, allowed: none, y, z, yz")]
pub struct UnknownMirror(String);

impl Mirror {
    /// Every choice.
    pub const ALL: [Self; 4] = [Self::None, Self::Y, Self::Z, Self::Yz];

    /// Name in lower case, as `FromStr` takes it.
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

/// What a reader hands on: the points in the axes of a profile.
pub(super) struct Laid {
    pub rows: Vec<Row>,
    /// Whether the reader turned the profile by half a turn.
    pub turned: bool,
}

/// What was read and what of it was left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Format of the file.
    pub format: Format,
    /// Whether the profile lay upside down and was turned by half a turn: MiniProf rails.
    pub turned: bool,
    /// Points of the file.
    pub points: usize,
    /// Points left out at the ends: beyond the widest point of a rail, above the back or the face of a wheel, or beyond
    /// [`REACH_MM`](super::REACH_MM).
    pub overhanging: usize,
    /// Points left out in between, behind folds and burrs.
    pub folded: usize,
    /// Width of the widest of these folds, mm.
    pub widest_fold_mm: f64,
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}, {} of {} points beyond the widest point left out",
            self.format, self.overhanging, self.points
        )?;
        if self.folded > 0 {
            write!(
                f,
                ", {} in folds of up to {:.3} mm",
                self.folded, self.widest_fold_mm
            )?;
        }
        if self.turned {
            f.write_str(", turned upright by half a turn")?;
        }
        Ok(())
    }
}
