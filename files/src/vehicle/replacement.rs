//! Replacement of a vehicle's dampers by another damper.

use std::fmt;
use std::str::FromStr;

use dashpot_core::DamperParameters;

/// Replacement of a vehicle's dampers by another damper, written `WHICH=DAMPER`. It also discards the overrides in
/// the replaced tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Replacement {
    /// Dampers to replace: a direction (longitudinal, lateral, vertical) or a name in the vehicle file. A name takes
    /// precedence over a direction.
    pub dampers: String,
    /// Preset or damper file; only a name for error messages if `parameters` is given.
    pub damper: String,
    /// Parameters of the new damper; `None` loads `damper`.
    pub parameters: Option<Box<DamperParameters>>,
}

impl Replacement {
    /// Replacement by a preset or a damper file.
    pub fn named(dampers: String, damper: String) -> Self {
        Self {
            dampers,
            damper,
            parameters: None,
        }
    }
}

impl fmt::Display for Replacement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.dampers, self.damper)
    }
}

impl FromStr for Replacement {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words = text.split_once('=');
        let words = words.map(|(dampers, damper)| (dampers.trim(), damper.trim()));
        match words {
            Some((dampers, damper)) if !dampers.is_empty() && !damper.is_empty() => {
                Ok(Self::named(dampers.to_owned(), damper.to_owned()))
            }
            _ => Err(format!(
                "`{text}`, allowed: WHICH=DAMPER, such as vertical=in-service"
            )),
        }
    }
}
