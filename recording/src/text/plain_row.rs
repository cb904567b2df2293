//! Rows of plain numbers, parsed without a CSV reader. Any other row is left to the CSV reader.

use memchr::memchr3;

use super::decimal::{self, Decimal};
use crate::text_options::{DecimalMark, Separator};

/// Parser of plain rows: the expected number of cells, without quotes, and with a finite number in each selected cell.
pub(super) struct PlainRows {
    separator: u8,
    /// For each cell of a row, the index of its value if the cell is selected.
    cells: Vec<Option<usize>>,
}

/// A parsed row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlainRow {
    /// Number of bytes with the line end.
    pub(super) length: usize,
    /// True if a number has a decimal mark.
    pub(super) has_mark: bool,
}

impl PlainRows {
    /// Returns the parser for rows of `cells` cells, of which `columns` are selected; `None` if a selected cell does
    /// not exist or is selected twice.
    pub(super) fn new(separator: Separator, cells: usize, columns: &[usize]) -> Option<Self> {
        let mut values = vec![None; cells];
        for (value, column) in columns.iter().enumerate() {
            if values.get_mut(*column)?.replace(value).is_some() {
                return None;
            }
        }
        Some(Self {
            separator: separator.byte(),
            cells: values,
        })
    }

    /// Parses the row at the start of `text` into `values`; `None` if the row is not plain. `text` contains a line
    /// feed.
    #[inline]
    pub(super) fn parse(
        &self,
        text: &[u8],
        mark: Option<DecimalMark>,
        values: &mut [f64],
    ) -> Option<PlainRow> {
        let mark = match mark {
            Some(DecimalMark::Comma) if self.separator == b',' => return None,
            Some(DecimalMark::Comma) => b',',
            Some(DecimalMark::Point) | None => b'.',
        };
        if text.first() == Some(&b'#') {
            return None;
        }
        let (mut at, mut has_mark) = (0, false);
        for (index, cell) in self.cells.iter().enumerate() {
            if index > 0 {
                at = self.after_separator(text, at)?;
            }
            at = after_spaces(text, at);
            if let Some(value) = cell {
                let Decimal {
                    number,
                    length,
                    has_mark: has,
                } = decimal::parse(text.get(at..)?, mark)?;
                *values.get_mut(*value)? = number;
                has_mark |= has;
                at += length;
            } else {
                at += self.length_of_skipped(text.get(at..)?)?;
            }
        }
        at = after_spaces(text, at);
        // A separator at the end is allowed.
        at += usize::from(*text.get(at)? == self.separator);
        at += usize::from(*text.get(at)? == b'\r');
        (*text.get(at)? == b'\n').then_some(PlainRow {
            length: at + 1,
            has_mark,
        })
    }

    /// Returns the position after the separator and any spaces before it; `None` if there is another byte.
    #[inline]
    fn after_separator(&self, text: &[u8], at: usize) -> Option<usize> {
        let next = after_spaces(text, at);
        if self.separator == b' ' {
            return (next > at).then_some(next);
        }
        (*text.get(next)? == self.separator).then_some(next + 1)
    }

    /// Length of a cell that is not selected; `None` if it is quoted.
    fn length_of_skipped(&self, text: &[u8]) -> Option<usize> {
        if text.first() == Some(&b'"') {
            return None;
        }
        memchr3(self.separator, b'\n', b'\r', text)
    }
}

#[inline]
fn after_spaces(text: &[u8], mut at: usize) -> usize {
    while text.get(at) == Some(&b' ') {
        at += 1;
    }
    at
}
