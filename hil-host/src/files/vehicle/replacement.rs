//! Dampers of a vehicle file replaced by another.

use std::fmt;
use std::str::FromStr;

use super::dampers::{DIRECTIONS, tables};
use super::error::VehicleFileError;
use crate::files::damper;
use crate::files::overrides::nearest;

/// Dampers of a vehicle file replaced by another, in words `dampers=damper`; the overrides of the file's table go with its damper.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Replacement {
    /// A direction (longitudinal, lateral, vertical), or the name of a damper in the vehicle file, which counts more.
    pub dampers: String,
    /// A preset or a damper file.
    pub by: String,
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
            Some((dampers, by)) if !dampers.is_empty() && !by.is_empty() => Ok(Self {
                dampers: dampers.to_owned(),
                by: by.to_owned(),
            }),
            _ => Err(format!(
                "`{text}`, allowed: dampers=damper, such as vertical=in-service"
            )),
        }
    }
}

/// Replaces dampers in the tables of a vehicle file.
pub(super) fn apply(
    tree: &mut toml::Table,
    replacements: &[Replacement],
) -> Result<(), VehicleFileError> {
    let is_direction = |replacement: &&Replacement| {
        DIRECTIONS
            .iter()
            .any(|(word, _)| *word == replacement.dampers)
    };
    let (along, named): (Vec<_>, Vec<_>) = replacements.iter().partition(is_direction);
    for (key, replacements) in [("direction", along), ("name", named)] {
        for replacement in replacements {
            replace(tree, key, replacement)?;
        }
    }
    Ok(())
}

/// Replaces the dampers whose `key` is what the replacement names.
fn replace(
    tree: &mut toml::Table,
    key: &str,
    replacement: &Replacement,
) -> Result<(), VehicleFileError> {
    let wrong = |reason: String| VehicleFileError::Replacement {
        replacement: replacement.clone(),
        reason,
    };
    let Replacement { dampers, by } = replacement;
    damper::load(by, &[]).map_err(|error| wrong(error.to_string()))?;
    let is_called = |table: &toml::Table, key, name: &str| {
        table.get(key).and_then(toml::Value::as_str) == Some(name)
    };
    let mut found = false;
    for table in tables(tree).filter(|table| is_called(table, key, dampers)) {
        table.insert("damper".into(), toml::Value::String(by.clone()));
        table.remove("set");
        found = true;
    }
    if found {
        return Ok(());
    }
    let names: Vec<String> = tables(tree)
        .filter_map(|table| Some(table.get("name")?.as_str()?.to_owned()))
        .collect();
    let directions = DIRECTIONS.iter().map(|(word, _)| *word);
    let known = directions.chain(names.iter().map(String::as_str));
    let hint = nearest(dampers, known.filter(|known| known != dampers));
    Err(wrong(format!("no damper `{dampers}`{hint}")))
}
