//! Curves of cases that the figures of a study's page draw: computed while the cases run, and kept beside the rows.

mod file;
mod journal;
mod needed;
mod recorder;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(super) use file::KnownRows;
pub use file::{KeptCurves, read, write};
pub(super) use journal::CurveJournal;
pub use needed::Needed;
pub(super) use needed::is_needed;
pub(super) use recorder::Recorder;

/// Form of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CurveKind {
    /// The value after each tick.
    History,
    /// Pairs of frequency, Hz, and power spectral density, in the unit of the signal squared per Hz, up to the highest
    /// frequency that figures show.
    Spectrum,
}

/// Identity of a curve.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct CurveKey {
    /// Number of the case.
    pub case: u64,
    /// Name of the signal, as in history.csv.
    pub signal: String,
    /// Form.
    pub kind: CurveKind,
}

/// A curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Step size of the run, s.
    pub step_s: f64,
    /// Values of a history, or frequency and density alternately.
    pub values: Vec<f64>,
}

/// Curves of cases.
pub type Curves = BTreeMap<CurveKey, Curve>;

/// Path of the curves that belong to the rows at `rows`.
///
/// ```
/// use dashpot_study::sweep::curves::path_of;
/// let path = path_of("results/rows-3-of-8.csv".as_ref());
/// assert_eq!(path.as_path(), std::path::Path::new("results/rows-3-of-8.curves"));
/// ```
pub fn path_of(rows: &Path) -> PathBuf {
    rows.with_extension("curves")
}

/// Appends an extension to a path.
pub(super) fn with_ending(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}

impl CurveKind {
    /// All forms.
    pub const ALL: [Self; 2] = [Self::History, Self::Spectrum];

    /// Name in the file of curves.
    pub fn name(self) -> &'static str {
        match self {
            Self::History => "history",
            Self::Spectrum => "spectrum",
        }
    }
}
