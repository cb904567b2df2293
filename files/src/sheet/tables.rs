//! The tables of a sheet file.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use serde::Deserialize;
use toml::Spanned;

use super::{Index, Limit, SheetFileError, SheetParameters, Test};
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
    least: Option<f64>,
    most: Option<f64>,
    clause: Option<String>,
}

impl SheetTables {
    /// The sheet in the file that was found.
    pub fn parameters(self, found: &Found) -> Result<SheetParameters, SheetFileError> {
        let wrong_at = |start: usize, message: String| SheetFileError::Line {
            name: found.name.clone(),
            line: line_at(&found.text, start),
            message,
        };
        if self.test.is_empty() {
            return Err(wrong_at(0, "test: allowed: one or more".into()));
        }
        let mut tests = Vec::new();
        let mut names = BTreeSet::new();
        for table in self.test {
            let start = table.span().start;
            let table = table.into_inner();
            if table.name.is_empty() || table.name.contains(char::is_control) {
                let message = "name of a test: allowed: one line that is not empty";
                return Err(wrong_at(start, message.into()));
            }
            if !names.insert(table.name.clone()) {
                return Err(wrong_at(start, format!("a second test `{}`", table.name)));
            }
            let in_test = |message| format!("test `{}`: {message}", table.name);
            let motion = table.motion();
            let motion = motion.map_err(|message| wrong_at(start, in_test(message)))?;
            let limits = table.limits.iter().map(|(index, limit)| {
                let refused = |message| {
                    let message = in_test(format!("{index}: {message}"));
                    wrong_at(limit.span().start, message)
                };
                limit.get_ref().limit(*index).map_err(refused)
            });
            tests.push(Test {
                motion,
                temperature_c: table.temperature_c,
                limits: limits.collect::<Result<_, _>>()?,
                line: line_at(&found.text, start),
                name: table.name,
            });
        }
        let fields = self.field.into_iter();
        Ok(SheetParameters {
            title: self.title,
            fields: fields.map(|field| (field.name, field.text)).collect(),
            tests,
            file: found.name.clone(),
        })
    }
}

impl TestTable {
    /// The motion, two of whose three numbers are given.
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
                    "allowed: two of `amplitude_m`, `frequency_hz` and `velocity_m_per_s` (the peak)"
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
        let (least, most) = (self.least, self.most);
        if !is_finite(least) || !is_finite(most) {
            return Err("allowed: finite numbers".into());
        }
        match (least, most) {
            (None, None) => Err("allowed: `least`, `most` or both".into()),
            (Some(least), Some(most)) if least > most => Err(format!(
                "least {least} above most {most}, allowed: at most that"
            )),
            _ => Ok(Limit {
                index,
                least,
                most,
                clause: self.clause.clone(),
            }),
        }
    }
}
