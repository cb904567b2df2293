//! Locations of rows in a file.

/// Location of a row in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RowLocation {
    /// Line of a text file, from 1.
    Line(u64),
    /// Row of a binary file, from 1. A row has one sample of each channel.
    Row(u64),
}

/// Rows that were omitted because a value was missing.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct LeftOut {
    /// Number of omitted rows.
    pub rows: u64,
    /// Location of the first omitted row.
    pub first: Option<RowLocation>,
}
