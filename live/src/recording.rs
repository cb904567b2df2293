//! Every tick of a run, in memory, until a page saves it.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

use crate::ActionError;

/// Largest recording, numbers: 256 MB.
const MAX_NUMBERS: usize = 64_000_000;

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
    pub fn file(&self, names: &[String], format: &str) -> Result<Value, ActionError> {
        if format != "csv" {
            return Err(ActionError::unknown("format", format, ["csv"].into_iter()));
        }
        let mut text = names.join(",");
        text.push('\n');
        for (time_s, row) in self
            .times_s
            .iter()
            .zip(self.values.chunks(names.len().max(1)))
        {
            // The first signal is the time, which needs more digits than a frame has.
            text.push_str(&time_s.to_string());
            for value in &row[1..] {
                text.push(',');
                text.push_str(&value.to_string());
            }
            text.push('\n');
        }
        Ok(json!({
            "type": "file", "name": "dashpot-live.csv", "mime": "text/csv",
            "base64": BASE64_STANDARD.encode(text),
        }))
    }
}
