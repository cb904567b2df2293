//! Table `vary` of a sweep, which describes one axis.

use std::path::Path;

use serde::Deserialize;

use super::axis::{Axis, MAX_VALUES, Value, WORN_DAMPER, may_name_files, range};

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
    /// Converts the table to an axis.
    ///
    /// # Errors
    /// Returns an error message that describes the problem.
    pub fn axis(self, folder: &Path) -> Result<Axis, String> {
        let parameter = self.parameter;
        let invalid = |reason: String| format!("{parameter}: {reason}");
        if self.values.is_some() && self.spacing.is_some() {
            return Err(invalid(
                "`spacing` given with `values`, allowed: with `from`, `to` and `count`".into(),
            ));
        }
        let factor = self.factor.unwrap_or(1.0);
        if !factor.is_finite() || factor == 0.0 {
            return Err(invalid(format!(
                "factor {factor}, allowed: finite numbers except 0"
            )));
        }
        let values = match (self.values, self.from, self.to, self.count) {
            (Some(values), None, None, None) => {
                let values = values
                    .into_iter()
                    .map(|value| Value::from_toml(value).map_err(&invalid));
                values.collect::<Result<Vec<_>, _>>()?
            }
            (None, Some(from), Some(to), Some(count)) => {
                let geometric = self.spacing == Some(Spacing::Geometric);
                if !(2..=MAX_VALUES).contains(&count) {
                    return Err(invalid(format!(
                        "count {count}, allowed: 2 to {MAX_VALUES}"
                    )));
                }
                if geometric && !(from > 0.0 && to > 0.0) {
                    let reason = format!("geometric spacing from {from} to {to}, allowed: above 0");
                    return Err(invalid(reason));
                }
                range(from, to, count, geometric)
            }
            _ => {
                return Err(invalid(
                    "give either `values`, or `from`, `to` and `count`".into(),
                ));
            }
        };
        if values.is_empty() || values.len() > MAX_VALUES {
            let count = values.len();
            return Err(invalid(format!(
                "{count} values, allowed: 1 to {MAX_VALUES}"
            )));
        }
        let finite = |value: &Value| !matches!(value, Value::Number(number) if !number.is_finite());
        if !values.iter().all(finite) {
            return Err(invalid("a value is not finite".into()));
        }
        for (number, value) in values.iter().enumerate() {
            if values[..number].contains(value) {
                return Err(invalid(format!("duplicate value {value}")));
            }
        }
        if (parameter == WORN_DAMPER) == self.set.is_empty() {
            return Err(invalid(format!(
                "`set` is required for `{WORN_DAMPER}` and not allowed for other parameters"
            )));
        }
        let values = match may_name_files(&parameter) {
            true => values
                .into_iter()
                .map(|value| value.resolve_name(folder))
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
