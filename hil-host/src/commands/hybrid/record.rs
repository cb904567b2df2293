//! A record of ground motion: a text file with the columns `time_s,acceleration_m_per_s2`.

use std::path::Path;

use crate::commands::failure::{Failure, Outcome};
use dashpot_files::input;

/// Longest record (s).
const LONGEST_S: f64 = 600.0;
/// Largest acceleration (m/s^2).
const LARGEST_M_PER_S2: f64 = 100.0;

/// Reads the rows of a record (s, m/s^2).
///
/// # Errors
/// The file cannot be read, or a row is not allowed; the message names the line.
pub(super) fn read(path: &Path) -> Outcome<Vec<(f64, f64)>> {
    let name = input::name(path);
    let name = name.display();
    let refused = |line: u64, what: &str| Failure::new(format!("{name}, line {line}: {what}"));
    let text = input::read_text(path).map_err(|error| Failure::new(error.to_string()))?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = ["time_s", "acceleration_m_per_s2"];
    let found = reader
        .headers()
        .map_err(|error| refused(1, &error.to_string()))?;
    if found.iter().ne(header) {
        return Err(refused(1, "must be time_s,acceleration_m_per_s2"));
    }
    let mut rows: Vec<(f64, f64)> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| Failure::new(format!("{name}: {error}")))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |column: usize| {
            let field = record.get(column).unwrap_or_default();
            let number = field
                .parse::<f64>()
                .ok()
                .filter(|number| number.is_finite());
            number.ok_or_else(|| refused(line, &format!("`{field}` is not a number")))
        };
        let (time_s, acceleration) = (number(0)?, number(1)?);
        if rows.last().is_some_and(|(before_s, _)| time_s <= *before_s) {
            return Err(refused(line, "time_s must increase"));
        }
        if acceleration.abs() > LARGEST_M_PER_S2 {
            return Err(refused(line, "acceleration_m_per_s2 must be -100 to 100"));
        }
        if rows
            .first()
            .is_some_and(|(first_s, _)| time_s - first_s > LONGEST_S)
        {
            return Err(refused(line, "the record must not be longer than 600 s"));
        }
        rows.push((time_s, acceleration));
    }
    match rows.len() {
        0 | 1 => Err(Failure::new(format!("{name}: must have at least two rows"))),
        _ => Ok(rows),
    }
}
