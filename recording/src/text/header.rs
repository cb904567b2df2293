//! Header of a text: column names, with units next to or below them.

use std::borrow::Cow;

use super::decode::characters;
use super::instant::Instant;
use super::number::is_number;
use crate::error::RecordingError;
use crate::select::{ChannelInfo, bare};
use crate::unit::Quantity;

/// True if the first row is a header, which means that at least one of its cells is not a number.
///
/// # Errors
/// Returns an error if the cells count up from 0 or 1: they could be numbers, or the names that pandas gives to unnamed
/// columns.
pub(super) fn is_header(cells: &[String]) -> Result<bool, RecordingError> {
    if cells.iter().any(|cell| !is_number(cell.as_bytes())) {
        return Ok(true);
    }
    let counts_from = |first: usize| {
        (first..)
            .zip(cells)
            .all(|(number, cell)| *cell == number.to_string())
    };
    if counts_from(0) || counts_from(1) {
        return Err(RecordingError::HeaderOrRow {
            cells: cells.join(" "),
        });
    }
    Ok(false)
}

/// Parses a column header: `Weg`, `Weg [mm]`, `Weg (mm)` or `Weg / mm`. Text in parentheses or after a slash may belong
/// to the name, so it is a unit only if the unit is known.
pub(in super::super) fn column_from_header(cell: &str) -> ChannelInfo {
    let parts = cell
        .strip_suffix(']')
        .and_then(|cell| cell.rsplit_once('['))
        .or_else(|| {
            let inside = cell.strip_suffix(')')?.rsplit_once('(');
            inside.filter(|(_, unit)| is_unit(unit))
        })
        .or_else(|| cell.rsplit_once('/').filter(|(_, unit)| is_unit(unit)));
    let (name, unit) = match parts {
        Some((name, unit)) => (name.trim(), Some(unit.trim().to_owned())),
        None => (cell, None),
    };
    ChannelInfo {
        name: name.to_owned(),
        whole: cell.to_owned(),
        unit,
        kind: "text".into(),
        is_number: true,
        ..ChannelInfo::default()
    }
}

/// Returns the units if the row below the header is a row of units, in which no cell is a number.
pub(super) fn units<'a>(cells: impl Iterator<Item = &'a [u8]>) -> Option<Vec<String>> {
    let cells: Vec<Cow<'_, str>> = cells.map(|cell| characters(cell.trim_ascii())).collect();
    let is_text = |cell: &Cow<'_, str>| !cell.is_empty() && !is_number(cell.as_bytes());
    let is_text_or_empty = |cell: &Cow<'_, str>| cell.is_empty() || is_text(cell);
    let is_row_of_units = cells.iter().all(is_text_or_empty) && cells.iter().any(is_text);
    is_row_of_units.then(|| cells.iter().map(|cell| bare(cell).to_owned()).collect())
}

/// Sets the units of the columns, except where the cell is empty.
pub(super) fn set_units(found: &mut [ChannelInfo], units: Vec<String>) {
    for (found, unit) in found.iter_mut().zip(units) {
        if !unit.is_empty() {
            found.unit = Some(unit);
        }
    }
}

/// Marks the columns whose cells in the first row are times with dates.
pub(super) fn set_instants<'a>(found: &mut [ChannelInfo], cells: impl Iterator<Item = &'a [u8]>) {
    for (found, cell) in found.iter_mut().zip(cells) {
        if Instant::parse(cell.trim_ascii()).is_some() {
            found.is_instant = true;
            found.unit = Some("s".into());
            found.kind = "timestamp".into();
        }
    }
}

/// True if the text is a known unit.
pub(super) fn is_unit(text: &str) -> bool {
    let quantities = [Quantity::Time, Quantity::Displacement, Quantity::Force];
    quantities
        .iter()
        .any(|quantity| quantity.unit(text.trim()).is_some())
}
