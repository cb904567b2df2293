//! Formats of profile files, and their detection.

use std::fmt;
use std::str::FromStr;

/// A format of profile files; the module [`measured`](super) describes their axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// Two columns in mm: lateral position and depth.
    Columns,
    /// The profile gauge MiniProf: a header of `Key=Value`, an empty line, the columns of `ColumnDef` in mm.
    MiniProf,
    /// SIMPACK: the sections `header`, `spline` and `point`.
    Simpack,
    /// GENSYS: two columns in mm, with its own axes.
    Gensys,
}

/// The name does not denote a [`Format`].
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}: unknown format, allowed: columns, miniprof, simpack, gensys")]
pub struct UnknownFormat(String);

impl Format {
    /// All formats.
    pub const ALL: [Self; 4] = [Self::Columns, Self::MiniProf, Self::Simpack, Self::Gensys];

    /// Name in lower case, as parsed by `FromStr`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Columns => "columns",
            Self::MiniProf => "miniprof",
            Self::Simpack => "simpack",
            Self::Gensys => "gensys",
        }
    }

    /// Detects the format of `text` from its header or, if it has none, from the file name extension.
    ///
    /// Text with an unknown extension is [`Format::Columns`].
    ///
    /// ```
    /// use dashpot_rail::profile::measured::Format;
    /// assert_eq!(Format::detect("spline.begin\n", Some("txt")), Format::Simpack);
    /// assert_eq!(Format::detect("-60.0 -2.6\n", Some("wheel")), Format::Gensys);
    /// assert_eq!(Format::detect("-60.0 -2.6\n", None), Format::Columns);
    /// ```
    pub fn detect(text: &str, extension: Option<&str>) -> Self {
        let lines = || text.lines().map(str::trim);
        if lines().any(|line| line.starts_with("header.begin") || line.starts_with("spline.begin"))
        {
            return Self::Simpack;
        }
        if super::miniprof::has_header(text) {
            return Self::MiniProf;
        }
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("whl" | "ban") => Self::MiniProf,
            Some("prw" | "prr") => Self::Simpack,
            Some("wheel" | "rail") => Self::Gensys,
            _ => Self::Columns,
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|format| format.name() == name);
        known.ok_or_else(|| UnknownFormat(name.to_owned()))
    }
}
