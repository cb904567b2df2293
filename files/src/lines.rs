//! Line numbers of a text.

use std::collections::BTreeMap;

use toml::de::{DeTable, DeValue};

/// Returns the line number, from 1, at a byte offset.
pub(crate) fn line_at(text: &str, offset: usize) -> u64 {
    let before = text.as_bytes().get(..offset).unwrap_or(text.as_bytes());
    1 + before.iter().filter(|byte| **byte == b'\n').count() as u64
}

/// Returns each key in the top-level table `table` of a TOML text with its line number, from 1. Returns none if the
/// text is not TOML or has no such table.
pub(crate) fn lines_of_keys(text: &str, table: &str) -> BTreeMap<String, u64> {
    let Ok(tree) = DeTable::parse(text) else {
        return BTreeMap::new();
    };
    let Some(DeValue::Table(keys)) = tree.get_ref().get(table).map(|value| value.get_ref()) else {
        return BTreeMap::new();
    };
    let line_of = |offset: usize| line_at(text, offset);
    keys.keys()
        .map(|key| (key.get_ref().to_string(), line_of(key.span().start)))
        .collect()
}
