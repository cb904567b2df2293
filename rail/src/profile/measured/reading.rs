//! Options for reading a profile file, and a summary of what was read.

use std::fmt;

use super::mirror::Mirror;
use super::{DEFAULT_SMOOTHING_M, Format};
use crate::setters::setters;

/// Options for reading a profile file.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Format of the file; `None` detects it from the content and the file name extension.
    pub format: Option<Format>,
    /// Axes of the file to mirror before the profile is checked. `None` mirrors no axis, and is an error for a GENSYS
    /// rail.
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
            "{}, {} of {} points removed at the ends",
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
            f.write_str(", rotated by 180 degrees")?;
        }
        Ok(())
    }
}
