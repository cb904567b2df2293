//! The dampers of a vehicle file.

use std::path::Path;

use dashpot_rail::vehicle::Direction;

use crate::files::shipped::named_in;

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
