//! Tables of a sheet file.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use serde::Deserialize;
use toml::Spanned;

use super::{Field, Index, Limit, SheetFileError, SheetParameters, Test};
use crate::harmonic::Harmonic;
use crate::lines::line_at;
use crate::shipped::Found;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SheetTables {
    title: String,
    #[serde(default)]
    field: Vec<FieldTable>,
    #[serde(default)]
    test: Vec<Spanned<TestTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FieldTable {
    name: String,
    text: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TestTable {
    name: String,
    amplitude_m: Option<f64>,
    frequency_hz: Option<f64>,
    velocity_m_per_s: Option<f64>,
    temperature_c: Option<f64>,
    #[serde(default)]
    limits: BTreeMap<Index, Spanned<LimitTable>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LimitTable {
    #[serde(rename = "least")]
    min: Option<f64>,
    #[serde(rename = "most")]
    max: Option<f64>,
    clause: Option<String>,
}

impl SheetTables {
    /// Converts the tables to a sheet.
    pub fn parameters(self, found: &Found) -> Result<SheetParameters, SheetFileError> {
        let error_at = |start: usize, message: String| SheetFileError::Line {
            name: found.name.clone(),
            line: line_at(&found.text, start),
            message,
        };
        if self.test.is_empty() {
            return Err(error_at(0, "no tests, allowed: one or more".into()));
        }
        let mut tests = Vec::new();
        let mut names = BTreeSet::new();
        for table in self.test {
            let start = table.span().start;
            let table = table.into_inner();
            if table.name.is_empty() || table.name.contains(char::is_control) {
                let message = "empty or multi-line name of a test, allowed: one line of text";
                return Err(error_at(start, message.into()));
            }
            if !names.insert(table.name.clone()) {
                return Err(error_at(
                    start,
                    format!("duplicate test name `{}`", table.name),
                ));
            }
            let in_test = |message| format!("test `{}`: {message}", table.name);
            let motion = table.motion();
            let motion = motion.map_err(|message| error_at(start, in_test(message)))?;
            let limits = table.limits.iter().map(|(index, limit)| {
                let invalid = |message| {
                    let message = in_test(format!("{index}: {message}"));
                    error_at(limit.span().start, message)
                };
                limit.get_ref().limit(*index).map_err(invalid)
            });
            tests.push(Test {
                motion,
                temperature_c: table.temperature_c,
                limits: limits.collect::<Result<_, _>>()?,
                line: line_at(&found.text, start),
                name: table.name,
            });
        }
        let fields = self
            .field
            .into_iter()
            .map(|FieldTable { name, text }| Field { name, text });
        Ok(SheetParameters {
            title: self.title,
            fields: fields.collect(),
            tests,
            file: found.name.clone(),
        })
    }
}

impl TestTable {
    /// Computes the motion from two of amplitude, frequency and peak velocity. Exactly two must be given.
    fn motion(&self) -> Result<Harmonic, String> {
        let velocity = self.velocity_m_per_s;
        if let Some(velocity) = velocity.filter(|velocity| velocity.is_nan() || *velocity <= 0.0) {
            return Err(format!("velocity_m_per_s {velocity}, allowed: above 0"));
        }
        let (amplitude_m, frequency_hz) = match (self.amplitude_m, self.frequency_hz, velocity) {
            (Some(amplitude), Some(frequency), None) => (amplitude, frequency),
            (Some(amplitude), None, Some(velocity)) => (amplitude, velocity / (TAU * amplitude)),
            (None, Some(frequency), Some(velocity)) => (velocity / (TAU * frequency), frequency),
            _ => {
                return Err(
                    "give exactly two of `amplitude_m`, `frequency_hz` and `velocity_m_per_s` (the peak)"
                        .into(),
                );
            }
        };
        let motion = Harmonic {
            amplitude_m,
            frequency_hz,
        };
        motion.check().map_err(|error| error.to_string())?;
        Ok(motion)
    }
}

impl LimitTable {
    fn limit(&self, index: Index) -> Result<Limit, String> {
        let is_finite = |end: Option<f64>| end.is_none_or(f64::is_finite);
        let (min, max) = (self.min, self.max);
        if !is_finite(min) || !is_finite(max) {
            return Err("not finite, allowed: finite numbers".into());
        }
        match (min, max) {
            (None, None) => Err("give `least`, `most` or both".into()),
            (Some(min), Some(max)) if min > max => {
                Err(format!("`least` {min} is greater than `most` {max}"))
            }
            _ => Ok(Limit {
                index,
                min,
                max,
                clause: self.clause.clone(),
            }),
        }
    }
}
