//! Replacement of dampers in the tables of a vehicle file.

use super::Replacement;
use super::dampers::{DIRECTIONS, tables};
use super::error::VehicleFileError;
use crate::damper;
use crate::overrides::did_you_mean;

/// Replaces dampers in the tables of a vehicle file. Returns the last replacement of each damper table.
///
/// Replacements by direction are applied before those by name, so a name takes precedence.
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
    let (by_direction, by_name): (Vec<_>, Vec<_>) = replacements.iter().partition(is_direction);
    for (key, replacements) in [("direction", by_direction), ("name", by_name)] {
        for replacement in replacements {
            replace(tree, key, replacement, &mut replaced)?;
        }
    }
    Ok(replaced)
}

/// Replaces the dampers whose `key` (`direction` or `name`) has the value that the replacement selects.
fn replace<'a>(
    tree: &mut toml::Table,
    key: &str,
    replacement: &'a Replacement,
    replaced: &mut [Option<&'a Replacement>],
) -> Result<(), VehicleFileError> {
    let invalid = |reason: String| VehicleFileError::Replacement {
        replacement: replacement.clone(),
        reason,
    };
    let Replacement {
        dampers,
        damper,
        parameters,
    } = replacement;
    if parameters.is_none() {
        damper::load(damper, &[]).map_err(|error| invalid(error.to_string()))?;
    }
    let has_value = |table: &toml::Table, key, value: &str| {
        table.get(key).and_then(toml::Value::as_str) == Some(value)
    };
    let mut found = false;
    let with_last = tables(tree).zip(replaced);
    for (table, last) in with_last.filter(|(table, _)| has_value(table, key, dampers)) {
        table.insert("damper".into(), toml::Value::String(damper.clone()));
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
    let hint = did_you_mean(dampers, known.filter(|known| known != dampers));
    Err(invalid(format!("no damper `{dampers}`{hint}")))
}
