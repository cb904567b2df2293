//! Detects the separator of a text from its first rows.

use csv::{ByteRecord, ReaderBuilder, Trim};

use super::number::is_number;
use crate::text_options::Separator;

/// Number of rows to inspect.
const ROWS: usize = 8;

/// Detects the separator of a text that starts with `head`, which must consist of whole lines. Among the separators
/// that split all rows into the same number of cells, it returns the one that yields the largest share of numbers.
pub(super) fn separator(head: &[u8]) -> Separator {
    let mut best: Option<(f64, Separator)> = None;
    for separator in Separator::ALL {
        if let Some(share) = share_of_numbers(head, separator)
            && best.is_none_or(|(largest, _)| share > largest)
        {
            best = Some((share, separator));
        }
    }
    best.map_or_else(|| most_in_first_row(head), |(_, separator)| separator)
}

/// Returns the share of numbers among the cells after the first row; `None` if the rows differ in length or have only
/// one cell.
fn share_of_numbers(head: &[u8], separator: Separator) -> Option<f64> {
    let rows = rows(head, separator);
    let length = rows.first()?.len();
    let fits = |row: &Vec<Vec<u8>>| {
        let longer = row.len() == length + 1 && row.last().is_some_and(Vec::is_empty);
        row.len() == length || longer
    };
    if length < 2 || !rows.iter().all(fits) {
        return None;
    }
    let cells: Vec<&Vec<u8>> = rows
        .iter()
        .skip(1)
        .flatten()
        .filter(|cell| !cell.is_empty())
        .collect();
    let numbers = cells.iter().filter(|cell| is_number(cell)).count();
    Some(numbers as f64 / cells.len().max(1) as f64)
}

/// Returns the separator with the most cells in the first row. This is used if no separator fits all rows; reading then
/// reports the row that does not fit.
fn most_in_first_row(head: &[u8]) -> Separator {
    let cells = |separator| rows(head, separator).first().map_or(0, Vec::len);
    let mut best = (cells(Separator::Comma), Separator::Comma);
    for separator in [Separator::Semicolon, Separator::Tab, Separator::Bar] {
        if cells(separator) > best.0 {
            best = (cells(separator), separator);
        }
    }
    best.1
}

/// Splits the first [`ROWS`] rows of a text into cells.
pub(super) fn rows(head: &[u8], separator: Separator) -> Vec<Vec<Vec<u8>>> {
    let mut reader = ReaderBuilder::new()
        .comment(Some(b'#'))
        .delimiter(separator.byte())
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(head);
    let mut rows = Vec::new();
    let mut record = ByteRecord::new();
    while rows.len() < ROWS && matches!(reader.read_byte_record(&mut record), Ok(true)) {
        rows.push(cells(&record, separator).map(<[u8]>::to_vec).collect());
    }
    rows
}

/// Returns the cells of a record. Several spaces count as one separator.
pub(super) fn cells(record: &ByteRecord, separator: Separator) -> impl Iterator<Item = &[u8]> {
    record
        .iter()
        .filter(move |cell| separator != Separator::Spaces || !cell.is_empty())
}
