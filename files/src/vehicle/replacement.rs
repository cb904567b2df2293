//! Dampers of a vehicle file replaced by another.

use std::fmt;
use std::str::FromStr;

use dashpot_core::DamperParameters;

use super::dampers::{DIRECTIONS, tables};
use super::error::VehicleFileError;
use crate::damper;
use crate::overrides::nearest;

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

/// Replaces dampers in the tables of a vehicle file, and tells for each table of dampers what replaced it last.
pub(super) fn apply<'a>(
    tree: &mut toml::Table,
    replacements: &'a [Replacement],
) -> Result<Vec<Option<&'a Replacement>>, VehicleFileError> {
    let mut replaced = vec![None; tables(tree).count()];
    let is_direction = |replacement: &&Replacement| {
        DIRECTIONS
            .iter()
            .any(|(word, _)| *word == replacement.dampers)
    };
    let (along, named): (Vec<_>, Vec<_>) = replacements.iter().partition(is_direction);
    for (key, replacements) in [("direction", along), ("name", named)] {
        for replacement in replacements {
            replace(tree, key, replacement, &mut replaced)?;
        }
    }
    Ok(replaced)
}

/// Replaces the dampers whose `key` is what the replacement names.
fn replace<'a>(
    tree: &mut toml::Table,
    key: &str,
    replacement: &'a Replacement,
    replaced: &mut [Option<&'a Replacement>],
) -> Result<(), VehicleFileError> {
    let wrong = |reason: String| VehicleFileError::Replacement {
        replacement: replacement.clone(),
        reason,
    };
    let Replacement { dampers, by, made } = replacement;
    if made.is_none() {
        damper::load(by, &[]).map_err(|error| wrong(error.to_string()))?;
    }
    let is_called = |table: &toml::Table, key, name: &str| {
        table.get(key).and_then(toml::Value::as_str) == Some(name)
    };
    let mut found = false;
    let with_last = tables(tree).zip(replaced);
    for (table, last) in with_last.filter(|(table, _)| is_called(table, key, dampers)) {
        table.insert("damper".into(), toml::Value::String(by.clone()));
        table.remove("set");
        *last = Some(replacement);
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
