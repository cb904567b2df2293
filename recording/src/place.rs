//! Positions of rows in a file.

/// Where a row is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// Line of a text, from 1.
    Line(u64),
    /// Row of another file, from 1: a sample of each channel.
    Row(u64),
}

/// Rows that a value was missing in and that were left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct LeftOut {
    /// How many.
    pub rows: u64,
    /// The first.
    pub first: Option<Place>,
}
