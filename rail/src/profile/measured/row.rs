//! A point of a file, and the parsing of its numbers.

use super::ProfileError;

/// A point, with its line in the file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Line of the text, counted from 1.
    pub line: u64,
    pub y_mm: f64,
    pub z_mm: f64,
}

/// The lines of `text` with line numbers, counted from 1.
pub(super) fn numbered(text: &str) -> impl Iterator<Item = (u64, &str)> {
    (1..).zip(text.lines())
}

/// The cells of a line, separated by commas, semicolons or white space.
pub(super) fn cells(line: &str) -> Vec<&str> {
    line.split(|c: char| c == ',' || c == ';' || c.is_whitespace())
        .filter(|cell| !cell.is_empty())
        .collect()
}

/// Parses a number from -1000 to 1000.
pub(super) fn number(line: u64, column: &'static str, cell: &str) -> Result<f64, ProfileError> {
    match cell.parse::<f64>() {
        Ok(value) if value.abs() <= 1000.0 => Ok(value),
        _ => Err(ProfileError::Number {
            line,
            column,
            text: cell.to_owned(),
        }),
    }
}
