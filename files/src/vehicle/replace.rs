//! Replaces dampers in the tables of a vehicle file.

use super::Replacement;
use super::dampers::{DIRECTIONS, tables};
use super::error::VehicleFileError;
use crate::damper;
use crate::overrides::nearest;

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
