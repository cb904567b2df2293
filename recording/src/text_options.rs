//! Options for reading text files.

use encoding_rs::Encoding;

/// Options for reading text files; options that are `None` are detected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TextOptions {
    /// Separator of the cells.
    pub separator: Option<Separator>,
    /// Decimal mark.
    pub decimal_mark: Option<DecimalMark>,
    /// True if the first line contains the column names.
    pub header: Option<bool>,
    /// Character encoding.
    pub encoding: Option<&'static Encoding>,
    /// Number of lines to skip before the header or the first row. Lines that start with `#` are always skipped.
    pub skip_lines: u64,
}

/// Separator of the cells of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// Tab.
    Tab,
    /// One or more spaces.
    Spaces,
    /// `|`
    Bar,
}

/// Decimal mark of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalMark {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

impl Separator {
    /// All separators, in order of preference if several fit.
    pub(crate) const ALL: [Self; 5] = [
        Self::Tab,
        Self::Semicolon,
        Self::Comma,
        Self::Bar,
        Self::Spaces,
    ];

    /// Returns the separator as a byte.
    pub(crate) fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Spaces => b' ',
            Self::Bar => b'|',
        }
    }

    /// Name for messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Comma => "commas",
            Self::Semicolon => "semicolons",
            Self::Tab => "tabs",
            Self::Spaces => "spaces",
            Self::Bar => "bars",
        }
    }
}
