//! The table of what varies in a sweep.

use std::path::Path;

use serde::Deserialize;

use super::axis::{Axis, MOST_VALUES, Value, WORN_DAMPER, names_files, range};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VaryTable {
    parameter: String,
    values: Option<Vec<toml::Value>>,
    from: Option<f64>,
    to: Option<f64>,
    count: Option<usize>,
    spacing: Option<Spacing>,
    #[serde(default)]
    set: Vec<String>,
    label: Option<String>,
    factor: Option<f64>,
}

#[derive(Deserialize, PartialEq, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum Spacing {
    Linear,
    Geometric,
}

impl VaryTable {
    /// The axis.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn axis(self, folder: &Path) -> Result<Axis, String> {
        let parameter = self.parameter;
        let wrong = |reason: String| format!("{parameter}: {reason}");
        if self.values.is_some() && self.spacing.is_some() {
            return Err(wrong(
                "`spacing` beside `values`, allowed: beside `from`, `to` and `count`".into(),
            ));
        }
        let factor = self.factor.unwrap_or(1.0);
        if !factor.is_finite() || factor == 0.0 {
            return Err(wrong(format!(
                "factor {factor}, allowed: a finite number but 0"
            )));
        }
        let values = match (self.values, self.from, self.to, self.count) {
            (Some(values), None, None, None) => {
                let values = values
                    .into_iter()
                    .map(|value| Value::of(value).map_err(&wrong));
                values.collect::<Result<Vec<_>, _>>()?
            }
            (None, Some(from), Some(to), Some(count)) => {
                let geometric = self.spacing == Some(Spacing::Geometric);
                if !(2..=MOST_VALUES).contains(&count) {
                    return Err(wrong(format!("count {count}, allowed: 2 to {MOST_VALUES}")));
                }
                if geometric && !(from > 0.0 && to > 0.0) {
                    let reason = format!("from {from} to {to} in equal ratios, allowed: above 0");
                    return Err(wrong(reason));
                }
                range(from, to, count, geometric)
            }
            _ => {
                return Err(wrong(
                    "allowed: either `values`, or `from`, `to` and `count`".into(),
                ));
            }
        };
        if values.is_empty() || values.len() > MOST_VALUES {
            let count = values.len();
            return Err(wrong(format!(
                "{count} values, allowed: 1 to {MOST_VALUES}"
            )));
        }
        let finite = |value: &Value| !matches!(value, Value::Number(number) if !number.is_finite());
        if !values.iter().all(finite) {
            return Err(wrong("a value that is no finite number".into()));
        }
        for (number, value) in values.iter().enumerate() {
            if values[..number].contains(value) {
                return Err(wrong(format!("value {value} twice")));
            }
        }
        if (parameter == WORN_DAMPER) == self.set.is_empty() {
            return Err(wrong(format!(
                "`set` belongs to `{WORN_DAMPER}`, and it cannot be without"
            )));
        }
        let values = match names_files(&parameter) {
            true => values
                .into_iter()
                .map(|value| value.named_in(folder))
                .collect(),
            false => values,
        };
        Ok(Axis {
            label: self.label.unwrap_or_else(|| parameter.clone()),
            parameter,
            values,
            set: self.set,
            factor,
        })
    }
}
