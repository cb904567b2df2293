//! Dampers that differ in one parameter.

use std::str::FromStr;

use dashpot_core::CheckedParameters;

use super::ResponseArguments;
use crate::commands::failure::{Failure, Outcome};
use dashpot_files::damper::{DamperError, KeyedParameters};

/// A parameter with values, written `KEY=VALUE,VALUE,...`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Family {
    pub(super) key: String,
    values: Vec<f64>,
}

impl FromStr for Family {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "allowed: KEY=VALUE,VALUE,... with numbers, such as mount.clearance_m=1e-3,2e-3";
        let (key, values) = text.split_once('=').ok_or(form)?;
        let number = |value: &str| value.trim().parse().ok().filter(|v: &f64| v.is_finite());
        let values: Option<Vec<f64>> = values.split(',').map(number).collect();
        Ok(Self {
            key: key.trim().to_owned(),
            values: values.ok_or(form)?,
        })
    }
}

/// A damper of the family with its parameter value.
pub(super) struct Member {
    pub(super) value: Option<f64>,
    pub(super) damper: CheckedParameters,
}

/// Builds the requested dampers.
///
/// # Errors
/// The damper, the key or a value is invalid.
pub(super) fn dampers(arguments: &ResponseArguments) -> Outcome<Vec<Member>> {
    let damper = arguments.damper.load()?;
    let Some(Family { key, values }) = &arguments.over else {
        return Ok(vec![Member {
            value: None,
            damper,
        }]);
    };
    let refused = |error: DamperError| Failure::wrong_use(format!("--over {key}: {error}"));
    let keyed = KeyedParameters::new(&arguments.damper.damper, &damper).map_err(refused)?;
    let member = |&value: &f64| {
        let damper = keyed.with(&[(key, value)]).map_err(refused)?;
        let value = Some(value);
        Ok(Member { value, damper })
    };
    values.iter().map(member).collect()
}
