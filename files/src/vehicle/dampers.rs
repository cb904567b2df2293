//! Damper tables of a vehicle file, and dampers of a vehicle by name.

use std::path::Path;

use dashpot_rail::vehicle::{Direction, Law, VehicleParameters};

use crate::overrides::did_you_mean;
use crate::shipped::resolve_name;

/// Names of the directions.
pub(crate) const DIRECTIONS: [(&str, Direction); 3] = [
    ("longitudinal", Direction::Longitudinal),
    ("lateral", Direction::Lateral),
    ("vertical", Direction::Vertical),
];

/// Returns the damper tables of a vehicle file.
pub(super) fn tables(tree: &mut toml::Table) -> impl Iterator<Item = &mut toml::Table> {
    tree.get_mut("damper")
        .and_then(toml::Value::as_array_mut)
        .into_iter()
        .flatten()
        .filter_map(toml::Value::as_table_mut)
}

/// Resolves the damper files in the tables relative to `folder`, the directory of the vehicle file.
pub(super) fn resolve_files(folder: &Path, tree: &mut toml::Table) {
    for table in tables(tree) {
        if let Some(toml::Value::String(damper)) = table.get_mut("damper") {
            *damper = resolve_name(folder, damper);
        }
    }
}

/// Returns the element indices of the dampers that `name` selects: all in a direction, all of one table by the table's
/// name, or one damper by name and number.
///
/// # Errors
/// Returns an error message, with a similar name, if there is no such damper.
pub(crate) fn find_dampers(vehicle: &VehicleParameters, name: &str) -> Result<Vec<usize>, String> {
    let all: Vec<(usize, &str, Direction)> = vehicle
        .elements
        .iter()
        .enumerate()
        .filter_map(|(index, element)| match element.law {
            Law::Damper { direction, .. } => Some((index, element.name.as_str(), direction)),
            _ => None,
        })
        .collect();
    let along = DIRECTIONS.iter().find(|(word, _)| *word == name);
    let is_numbered = |element: &str| {
        let rest = element.strip_prefix(name).and_then(|r| r.strip_prefix(' '));
        rest.is_some_and(|number| number.parse::<u32>().is_ok())
    };
    let found: Vec<usize> = all
        .iter()
        .filter(|(_, element, direction)| match along {
            Some((_, along)) => direction == along,
            None => *element == name || is_numbered(element),
        })
        .map(|(index, ..)| *index)
        .collect();
    if found.is_empty() {
        let directions = DIRECTIONS.iter().map(|(word, _)| *word);
        let known = directions.chain(all.iter().map(|(_, element, _)| *element));
        return Err(format!("no damper `{name}`{}", did_you_mean(name, known)));
    }
    Ok(found)
}
