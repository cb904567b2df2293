//! Tables of a sheet file.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use serde::Deserialize;
use toml::Spanned;

use super::{Field, Index, Limit, SheetFileError, SheetParameters, Test, Tolerance};
use crate::harmonic::Harmonic;
use crate::lines::line_at;
use crate::shipped::Found;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SheetTables {
    title: String,
    motion_tolerance_percent: Option<f64>,
    temperature_tolerance_k: Option<f64>,
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
    nominal: Option<f64>,
    tolerance_percent: Option<f64>,
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
        let tolerance = self.tolerance();
        let tolerance = tolerance.map_err(|message| error_at(0, message))?;
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
            tolerance,
            file: found.name.clone(),
        })
    }
}

/// Returns a percentage or temperature difference called `key`.
fn checked(key: &str, value: f64, max: f64) -> Result<f64, String> {
    match value > 0.0 && value <= max {
        true => Ok(value),
        false => Err(format!("{key} {value}, allowed: above 0, at most {max}")),
    }
}

impl SheetTables {
    fn tolerance(&self) -> Result<Tolerance, String> {
        let mut tolerance = Tolerance::default();
        if let Some(percent) = self.motion_tolerance_percent {
            tolerance.motion_percent = checked("motion_tolerance_percent", percent, 50.0)?;
        }
        if let Some(kelvin) = self.temperature_tolerance_k {
            tolerance.temperature_k = checked("temperature_tolerance_k", kelvin, 100.0)?;
        }
        Ok(tolerance)
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
        let values = [self.min, self.max, self.nominal];
        if values.into_iter().flatten().any(|value| !value.is_finite()) {
            return Err("not finite, allowed: finite numbers".into());
        }
        let (min, max) = self.ends()?;
        Ok(Limit {
            index,
            min,
            max,
            nominal: self.nominal,
            clause: self.clause.clone(),
        })
    }

    /// Returns minimum and maximum, which are given or computed from a nominal value and its tolerance.
    fn ends(&self) -> Result<(Option<f64>, Option<f64>), String> {
        match (self.min, self.max, self.nominal, self.tolerance_percent) {
            (None, None, Some(nominal), Some(percent)) => {
                let width = nominal.abs() * 0.01 * checked("tolerance_percent", percent, 1000.0)?;
                Ok((Some(nominal - width), Some(nominal + width)))
            }
            (Some(min), Some(max), None, None) if min > max => {
                Err(format!("`least` {min} is greater than `most` {max}"))
            }
            (Some(_), _, None, None) | (_, Some(_), None, None) => Ok((self.min, self.max)),
            _ => Err(
                "give `least`, `most` or both; or `nominal` together with `tolerance_percent`"
                    .into(),
            ),
        }
    }
}
