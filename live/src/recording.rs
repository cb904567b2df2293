//! Every tick of a run, in memory, until a page saves it.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use falcon_mdf::Mf4Writer;
use serde_json::{Value, json};

use crate::unknown_name::UnknownName;
use crate::{ActionError, SignalWords};

/// Largest recording, numbers: 64 MB, more than a minute of a locomotive. A file takes several times as much.
const MAX_NUMBERS: usize = 16_000_000;

/// Writes a recording whose signals have these names.
type Write = fn(&Recording, &[String]) -> Result<Vec<u8>, ActionError>;

/// Formats of a file: their names, the file's name and type, and what writes it.
const FORMATS: [(&str, &str, &str, Write); 2] = [
    ("csv", "dashpot-live.csv", "text/csv", Recording::csv),
    (
        "mdf4",
        "dashpot-live.mf4",
        "application/octet-stream",
        Recording::mdf4,
    ),
];

/// A recording.
#[derive(Debug, Clone, Default)]
pub(crate) struct Recording {
    is_on: bool,
    times_s: Vec<f64>,
    values: Vec<f32>,
}

impl Recording {
    /// Begins a new recording, or ends it.
    pub fn turn(&mut self, on: bool) {
        if on {
            *self = Self::default();
        }
        self.is_on = on;
    }

    pub fn is_on(&self) -> bool {
        self.is_on
    }

    pub fn ticks(&self) -> u64 {
        self.times_s.len() as u64
    }

    /// Takes a tick; ends the recording when it is full.
    pub fn add(&mut self, values: &[f32], time_s: f64) {
        if !self.is_on {
            return;
        }
        self.is_on = self.values.len() + values.len() <= MAX_NUMBERS;
        if self.is_on {
            self.times_s.push(time_s);
            self.values.extend(values);
        }
    }

    /// The recording as a message with a file.
    ///
    /// # Errors
    /// The format is none of `csv` and `mdf4`, or nothing is recorded.
    pub fn file(&self, names: &[String], format: &str) -> Result<Value, ActionError> {
        let formats = FORMATS.map(|(format, ..)| format).into_iter();
        let found = FORMATS.iter().find(|(known, ..)| *known == format);
        let Some((_, name, mime, write)) = found else {
            return Err(UnknownName::new("format", format, formats).into());
        };
        if self.times_s.is_empty() {
            return Err(ActionError::State("nothing is recorded"));
        }
        let content = write(self, names)?;
        Ok(json!({
            "type": "file", "name": name, "mime": mime, "base64": BASE64_STANDARD.encode(content),
        }))
    }

    fn csv(&self, names: &[String]) -> Result<Vec<u8>, ActionError> {
        let mut text = names.join(",");
        text.push('\n');
        for (time_s, row) in self
            .times_s
            .iter()
            .zip(self.values.chunks(names.len().max(1)))
        {
            // The first signal is the time, which needs more digits than a frame has.
            text.push_str(&time_s.to_string());
            for value in row.iter().skip(1) {
                text.push(',');
                text.push_str(&value.to_string());
            }
            text.push('\n');
        }
        Ok(text.into_bytes())
    }

    fn mdf4(&self, names: &[String]) -> Result<Vec<u8>, ActionError> {
        let failed = |_| ActionError::State("the recording cannot be written as MDF4");
        // The start time is unknown. The epoch makes files reproducible.
        let mut writer = Mf4Writer::with_start_time_ns(0);
        let group = writer.add_group(&self.times_s).map_err(failed)?;
        for (number, name) in names.iter().enumerate().skip(1) {
            let rows = self.values.chunks(names.len());
            let values: Vec<f64> = rows.map(|row| f64::from(row[number])).collect();
            let unit = SignalWords::of(name).unit();
            group.add_channel(name, unit, &values).map_err(failed)?;
        }
        let mut bytes = Vec::new();
        writer.write(&mut bytes).map_err(failed)?;
        Ok(bytes)
    }
}
