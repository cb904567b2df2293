//! How text is read, where it does not tell.

use encoding_rs::Encoding;

/// How the text of a recording is read; what is not given is found in the text.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TextOptions {
    /// What separates cells.
    pub separator: Option<Separator>,
    /// The mark before the decimals.
    pub decimal_mark: Option<DecimalMark>,
    /// Whether the first line has the names of the columns.
    pub header: Option<bool>,
    /// How characters are written as bytes.
    pub encoding: Option<&'static Encoding>,
    /// Lines before the header or the first row, beside those that start with `#`.
    pub skip_lines: u64,
}

/// What separates the cells of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// Tabulator.
    Tab,
    /// One or more spaces.
    Spaces,
    /// `|`
    Bar,
}

/// The mark before the decimals of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalMark {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

impl Separator {
    /// All, in the order in which they are preferred where two fit.
    pub(super) const ALL: [Self; 5] = [
        Self::Tab,
        Self::Semicolon,
        Self::Comma,
        Self::Bar,
        Self::Spaces,
    ];

    /// Its byte.
    pub(super) fn byte(self) -> u8 {
        match self {
            Self::Comma => b',',
            Self::Semicolon => b';',
            Self::Tab => b'\t',
            Self::Spaces => b' ',
            Self::Bar => b'|',
        }
    }

    /// Its name in a message.
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
