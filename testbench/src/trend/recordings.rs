//! Which recording is of which damper, and when it was made: an index file, or the names of folders and files.

use std::fs;
use std::path::{Path, PathBuf};

use chrono::NaiveDate;
use serde::Deserialize;

use super::limits::Kind;
use dashpot_files::FileError;

/// Name of the index file in the folder of the recordings.
pub const INDEX: &str = "recordings.csv";

/// A recording of one damper.
#[derive(Clone, Debug, PartialEq)]
pub struct Listed {
    /// Vehicle.
    pub vehicle: String,
    /// Position of the damper in the vehicle.
    pub damper: String,
    /// Serial number; a new one at the same position is another damper.
    pub serial_number: String,
    /// Where the damper works.
    pub kind: Kind,
    /// Preset or file of the damper's model; `None` for that of all.
    pub model: Option<String>,
    /// Date of the recording; `None` if its file name does not begin with one.
    pub date: Option<NaiveDate>,
    /// Mileage of the vehicle (km).
    pub mileage_km: Option<f64>,
    /// Temperature of the oil (degC).
    pub temperature_c: Option<f64>,
    /// Path of the recording.
    pub file: PathBuf,
}

/// A row of the index file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    vehicle: String,
    damper: String,
    date: String,
    file: PathBuf,
    #[serde(default)]
    mileage_km: Option<f64>,
    #[serde(default)]
    temperature_c: Option<f64>,
    #[serde(default)]
    serial_number: String,
    #[serde(default)]
    kind: Option<String>,
    #[serde(default)]
    model: Option<String>,
}

/// Lists the recordings in `folder`: those in its `recordings.csv`, otherwise every file VEHICLE/DAMPER/DATE.EXTENSION.
///
/// # Errors
/// The folder or the index file cannot be read, a row of it is invalid, or there is no recording.
pub fn list(folder: &Path) -> Result<Vec<Listed>, FileError> {
    let index = folder.join(INDEX);
    let listed = match index.is_file() {
        true => from_index(folder, &index)?,
        false => from_names(folder)?,
    };
    if listed.is_empty() {
        let reason = format!(
            "no recording; allowed: a file {INDEX} that lists them, or files VEHICLE/DAMPER/DATE.EXTENSION"
        );
        return Err(FileError::in_file(folder, reason));
    }
    Ok(listed)
}

fn from_index(folder: &Path, index: &Path) -> Result<Vec<Listed>, FileError> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_path(index)
        .map_err(|error| FileError::in_file(index, error))?;
    let mut listed = Vec::new();
    let headers = reader
        .headers()
        .map_err(|error| FileError::in_file(index, error))?
        .clone();
    let mut record = csv::StringRecord::new();
    loop {
        let is_row = reader
            .read_record(&mut record)
            .map_err(|error| FileError::in_file(index, error))?;
        if !is_row {
            return Ok(listed);
        }
        let line = record.position().map_or(0, csv::Position::line);
        let row: Row = record
            .deserialize(Some(&headers))
            .map_err(|error| FileError::in_line(index, line, reason(&error)))?;
        let cell = |column: &str, reason: String| FileError::in_cell(index, line, column, reason);
        for (column, text) in [("vehicle", &row.vehicle), ("damper", &row.damper)] {
            if text.is_empty() {
                return Err(cell(column, "empty; allowed: a name".into()));
            }
        }
        let date = date_at_start(&row.date)
            .ok_or_else(|| cell("date", format!("{:?}, allowed: YYYY-MM-DD", row.date)))?;
        for (column, value) in [
            ("mileage_km", row.mileage_km),
            ("temperature_c", row.temperature_c),
        ] {
            if value.is_some_and(|value| !value.is_finite()) {
                return Err(cell(
                    column,
                    "not finite; allowed: a number or nothing".into(),
                ));
            }
        }
        let kind = match row.kind.as_deref().unwrap_or_default() {
            "" => Kind::in_name(&row.damper),
            name => Kind::ALL
                .into_iter()
                .find(|kind| kind.name() == name)
                .ok_or_else(|| {
                    cell("kind", format!("{name:?}, allowed: vertical, lateral, yaw"))
                })?,
        };
        listed.push(Listed {
            kind,
            date: Some(date),
            file: folder.join(row.file),
            model: row
                .model
                .filter(|model| !model.is_empty())
                .map(|model| in_folder(folder, model)),
            vehicle: row.vehicle,
            damper: row.damper,
            serial_number: row.serial_number,
            mileage_km: row.mileage_km,
            temperature_c: row.temperature_c,
        });
    }
}

/// Returns the path of a model that is a file in the folder; otherwise its name, of a preset or of another file.
fn in_folder(folder: &Path, model: String) -> String {
    let path = folder.join(&model);
    if path.is_file() {
        path.display().to_string()
    } else {
        model
    }
}

/// Returns the reason without the position, which the error of the line has already.
fn reason(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => format!(
            "{err}; columns: vehicle, damper, date, file; optional: mileage_km, temperature_c, serial_number, \
             kind, model"
        ),
        _ => error.to_string(),
    }
}

fn from_names(folder: &Path) -> Result<Vec<Listed>, FileError> {
    let mut listed = Vec::new();
    for vehicle in entries(folder)?.into_iter().filter(|path| path.is_dir()) {
        for damper in entries(&vehicle)?.into_iter().filter(|path| path.is_dir()) {
            for file in entries(&damper)?.into_iter().filter(|path| !path.is_dir()) {
                let (vehicle, damper) = (name(&vehicle), name(&damper));
                listed.push(Listed {
                    kind: Kind::in_name(&damper),
                    date: date_at_start(&name(&file)),
                    vehicle,
                    damper,
                    serial_number: String::new(),
                    model: None,
                    mileage_km: None,
                    temperature_c: None,
                    file,
                });
            }
        }
    }
    Ok(listed)
}

/// Returns what a folder contains, sorted by name, without hidden files.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let unreadable = |error| FileError::read(folder, error);
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if !name(&path).starts_with('.') {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}

fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// Returns the date YYYY-MM-DD with which a text begins; a time or a name may follow.
fn date_at_start(text: &str) -> Option<NaiveDate> {
    let (date, rest) = text.split_at_checked("2026-03-14".len())?;
    let goes_on = rest.starts_with(|c: char| c.is_ascii_digit());
    // Chrono also takes dates with a sign or with fewer digits.
    let has_form = date.bytes().enumerate().all(|(at, byte)| match at {
        4 | 7 => byte == b'-',
        _ => byte.is_ascii_digit(),
    });
    NaiveDate::parse_from_str(date, "%Y-%m-%d")
        .ok()
        .filter(|_| has_form && !goes_on)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_date_may_be_followed_by_a_time_or_a_name_but_not_by_a_digit() {
        let date = NaiveDate::from_ymd_opt(2026, 3, 14);
        for text in [
            "2026-03-14",
            "2026-03-14.mf4",
            "2026-03-14T0830.csv.gz",
            "2026-03-14 run 7.parquet",
        ] {
            assert_eq!(date_at_start(text), date, "{text}");
        }
        for text in [
            "2026-03-141",
            "2026-02-30",
            "2026-3-14.csv",
            "+2026-03-1",
            "",
            "14.03.2026",
            "2026-03-1é",
        ] {
            assert_eq!(date_at_start(text), None, "{text}");
        }
    }

    #[test]
    fn the_kind_is_a_word_of_the_name() {
        assert_eq!(Kind::in_name("front-Yaw-1"), Kind::Yaw);
        assert_eq!(Kind::in_name("rear lateral"), Kind::Lateral);
        assert_eq!(Kind::in_name("front-left-secondary"), Kind::Vertical);
        assert_eq!(Kind::in_name("crawl"), Kind::Vertical);
    }
}
