//! The header of a text: names of columns, and their units beside or under them.

use std::borrow::Cow;

use super::super::error::RecordingError;
use super::super::select::{Found, bare};
use super::super::unit::Quantity;
use super::decode::characters;
use super::number::is_number;

/// Whether the first row has names: one of its cells at least is no number.
///
/// # Errors
/// Its cells count from 0 or 1: pandas names columns so that have no names, and it may be a row too.
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

/// A column by its header: `Weg`, `Weg [mm]`, `Weg (mm)` or `Weg / mm`; round brackets and a stroke may be part of the name, and are not a
/// unit unless a known one.
pub(in super::super) fn found(cell: &str) -> Found {
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
    Found {
        name: name.to_owned(),
        whole: cell.to_owned(),
        unit,
        kind: "text".into(),
        is_number: true,
        ..Found::default()
    }
}

/// The units in the row under the header, where it is one: no cell of it is a number.
pub(super) fn units<'a>(cells: impl Iterator<Item = &'a [u8]>) -> Option<Vec<String>> {
    let cells: Vec<Cow<'_, str>> = cells.map(|cell| characters(cell.trim_ascii())).collect();
    let is_text = |cell: &Cow<'_, str>| !cell.is_empty() && !is_number(cell.as_bytes());
    let is_text_or_empty = |cell: &Cow<'_, str>| cell.is_empty() || is_text(cell);
    let is_row_of_units = cells.iter().all(is_text_or_empty) && cells.iter().any(is_text);
    is_row_of_units.then(|| cells.iter().map(|cell| bare(cell).to_owned()).collect())
}

/// Notes the units under the names, those that are empty but for.
pub(super) fn take_units(found: &mut [Found], units: Vec<String>) {
    for (found, unit) in found.iter_mut().zip(units) {
        if !unit.is_empty() {
            found.unit = Some(unit);
        }
    }
}

fn is_unit(text: &str) -> bool {
    let quantities = [Quantity::Time, Quantity::Displacement, Quantity::Force];
    quantities
        .iter()
        .any(|quantity| quantity.unit(text.trim()).is_some())
}
