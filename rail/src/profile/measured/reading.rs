//! Options for reading a profile file, and a summary of what was read.

use std::fmt;
use std::str::FromStr;

use super::row::Row;
use super::{DEFAULT_SMOOTHING_M, Format};
use crate::setters::setters;

/// Options for reading a profile file.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Format of the file; `None` detects it from the content and the file name extension.
    pub format: Option<Format>,
    /// Axes of the file to mirror first. `None` mirrors none, and is an error for a GENSYS rail.
    pub mirror: Option<Mirror>,
    /// Wavelength whose amplitude the smoothing halves, m: [`Profile::through`](crate::profile::Profile::through).
    pub smoothing_m: f64,
}

impl Options {
    /// Detects the format, mirrors no axis, and smooths by [`DEFAULT_SMOOTHING_M`].
    pub const fn new() -> Self {
        Self {
            format: None,
            mirror: None,
            smoothing_m: DEFAULT_SMOOTHING_M,
        }
    }

    setters! {
        with_format sets format: Option<Format>;
        with_mirror sets mirror: Option<Mirror>;
        with_smoothing_m sets smoothing_m: f64;
    }
}

impl Default for Options {
    fn default() -> Self {
        Self::new()
    }
}

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

/// Summary of a file that was read, and of the points that were removed.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Reading {
    /// Format of the file.
    pub format: Format,
    /// True if the profile was upside down and has been rotated by 180 degrees (MiniProf rails).
    pub turned: bool,
    /// Number of points in the file.
    pub points: usize,
    /// Number of points removed at the ends: beyond the widest point of a rail, above the back or the face of a wheel,
    /// or beyond [`REACH_MM`](super::REACH_MM).
    pub overhanging: usize,
    /// Number of points removed in between, behind folds and burrs.
    pub folded: usize,
    /// Width of the widest fold, mm.
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
