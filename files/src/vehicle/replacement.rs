//! Dampers of a vehicle file replaced by another.

use std::fmt;
use std::str::FromStr;

use dashpot_core::DamperParameters;

/// Dampers of a vehicle file replaced by another, in words `dampers=damper`; the overrides of the file's table go with its damper.
#[derive(Debug, Clone, PartialEq)]
pub struct Replacement {
    /// A direction (longitudinal, lateral, vertical), or the name of a damper in the vehicle file, which counts more.
    pub dampers: String,
    /// A preset or a damper file; how `made` is called in errors, where there is that.
    pub by: String,
    /// A damper in memory.
    pub made: Option<Box<DamperParameters>>,
}

impl Replacement {
    /// By a preset or a damper file.
    pub fn named(dampers: String, by: String) -> Self {
        let made = None;
        Self { dampers, by, made }
    }
}

impl fmt::Display for Replacement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.dampers, self.by)
    }
}

impl FromStr for Replacement {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words = text.split_once('=');
        let words = words.map(|(dampers, by)| (dampers.trim(), by.trim()));
        match words {
            Some((dampers, by)) if !dampers.is_empty() && !by.is_empty() => {
                Ok(Self::named(dampers.to_owned(), by.to_owned()))
            }
            _ => Err(format!(
                "`{text}`, allowed: dampers=damper, such as vertical=in-service"
            )),
        }
    }
}
