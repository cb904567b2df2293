//! The dampers of a vehicle file, and those of a vehicle by what they are called.

use std::path::Path;

use dashpot_rail::vehicle::{Direction, Law, VehicleParameters};

use crate::overrides::nearest;
use crate::shipped::named_in;

/// Words of the directions.
pub(crate) const DIRECTIONS: [(&str, Direction); 3] = [
    ("longitudinal", Direction::Longitudinal),
    ("lateral", Direction::Lateral),
    ("vertical", Direction::Vertical),
];

/// The tables of dampers.
pub(super) fn tables(tree: &mut toml::Table) -> impl Iterator<Item = &mut toml::Table> {
    tree.get_mut("damper")
        .and_then(toml::Value::as_array_mut)
        .into_iter()
        .flatten()
        .filter_map(toml::Value::as_table_mut)
}

/// Lets the damper files that the tables name count from `folder`, where the vehicle file is.
pub(super) fn name_files_from(folder: &Path, tree: &mut toml::Table) {
    for table in tables(tree) {
        if let Some(toml::Value::String(damper)) = table.get_mut("damper") {
            *damper = named_in(folder, damper);
        }
    }
}

/// Numbers of the elements that `name` stands for: a direction for all dampers along it, the name in the vehicle file for those of one
/// table, or one damper by its name and number.
///
/// # Errors
/// There is no such damper; in words, with the nearest name.
pub(crate) fn called(vehicle: &VehicleParameters, name: &str) -> Result<Vec<usize>, String> {
    let all: Vec<(usize, &str, Direction)> = vehicle
        .elements
        .iter()
        .enumerate()
        .filter_map(|(number, element)| match element.law {
            Law::Damper { direction, .. } => Some((number, element.name.as_str(), direction)),
            _ => None,
        })
        .collect();
    let along = DIRECTIONS.iter().find(|(word, _)| *word == name);
    let numbered = |element: &str| {
        let rest = element.strip_prefix(name).and_then(|r| r.strip_prefix(' '));
        rest.is_some_and(|number| number.parse::<u32>().is_ok())
    };
    let found: Vec<usize> = all
        .iter()
        .filter(|(_, element, direction)| match along {
            Some((_, along)) => direction == along,
            None => *element == name || numbered(element),
        })
        .map(|(number, ..)| *number)
        .collect();
    if found.is_empty() {
        let directions = DIRECTIONS.iter().map(|(word, _)| *word);
        let known = directions.chain(all.iter().map(|(_, element, _)| *element));
        return Err(format!("no damper `{name}`{}", nearest(name, known)));
    }
    Ok(found)
}
