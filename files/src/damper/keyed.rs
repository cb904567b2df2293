//! Damper parameters addressed by key.

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{self, DamperParameters, Range};

use super::{ContentError, DamperError, DamperFile, from_file};
use crate::overrides::{did_you_mean, explain};

/// A damper whose numbers are read and set by key, `table.key`.
///
/// ```
/// use dashpot_files::damper::{KeyedParameters, load};
/// let damper = KeyedParameters::new("reduced", &*load("reduced-vertical", &[])?)?;
/// assert_eq!(damper.number("mount.stiffness_n_per_m")?, 8e6);
/// let softer = damper.with(&[("mount.stiffness_n_per_m", 4e6)])?;
/// assert_eq!(softer.mount.stiffness_n_per_m, 4e6);
/// # Ok::<(), dashpot_files::damper::DamperError>(())
/// ```
#[derive(Clone, Debug)]
pub struct KeyedParameters {
    name: String,
    tree: toml::Table,
}

impl KeyedParameters {
    /// Wraps `damper`; error messages call it `name`.
    ///
    /// # Errors
    /// Returns an error if the damper cannot be written as a file.
    pub fn new(name: &str, damper: &DamperParameters) -> Result<Self, DamperError> {
        let tree = toml::Table::try_from(DamperFile::new(damper.clone()));
        let name = name.to_owned();
        match tree {
            Ok(tree) => Ok(Self { name, tree }),
            Err(error) => {
                let source = ContentError::Tables(error.to_string());
                Err(DamperError::Overridden { name, source })
            }
        }
    }

    /// Name of the damper in error messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the number at `key`, in the unit of the key.
    ///
    /// # Errors
    /// Returns an error if this damper has no number at `key`.
    pub fn number(&self, key: &str) -> Result<f64, DamperError> {
        let value = find(&self.tree, key).and_then(toml::Value::as_float);
        value.ok_or_else(|| {
            let keys = self.keys();
            let hint = did_you_mean(key, keys.iter().map(String::as_str));
            DamperError::NoNumber {
                name: self.name.clone(),
                key: key.into(),
                hint,
            }
        })
    }

    /// Returns the keys of all numbers, in order.
    pub fn keys(&self) -> Vec<String> {
        let mut keys = Vec::new();
        collect_keys(&self.tree, "", &mut keys);
        keys
    }

    /// Returns the damper with these numbers changed.
    ///
    /// # Errors
    /// Returns an error for a key without a number or a number out of range.
    pub fn with(&self, numbers: &[(&str, f64)]) -> Result<CheckedParameters, DamperError> {
        let mut tree = self.tree.clone();
        for (key, number) in numbers {
            self.number(key)?;
            if let Some(value) = find_mut(&mut tree, key) {
                *value = toml::Value::Float(*number);
            }
        }
        let file: Result<DamperFile, _> = tree.try_into();
        file.map_err(|error| ContentError::Tables(explain(&error)))
            .and_then(from_file)
            .map_err(|source| DamperError::Overridden {
                name: self.name.clone(),
                source,
            })
    }
}

/// Writes a damper as the text of a damper file.
///
/// # Errors
/// Returns an error if the damper cannot be written as TOML.
///
/// ```
/// use dashpot_files::damper::{load, parse, text};
/// let damper = load("in-service", &[])?;
/// assert_eq!(*parse("again", &text(&damper)?, &[])?, *damper);
/// # Ok::<(), dashpot_files::damper::DamperError>(())
/// ```
pub fn text(damper: &DamperParameters) -> Result<String, DamperError> {
    let written = toml::to_string(&DamperFile::new(damper.clone()));
    let written = written.map_err(|error| DamperError::Overridden {
        name: "damper".into(),
        source: ContentError::Tables(error.to_string()),
    })?;
    let lines = written.lines().map(|line| with_exponent(line) + "\n");
    Ok(lines.collect())
}

/// Rewrites a TOML line so that a very small or large number has an exponent; the value stays the same.
fn with_exponent(line: &str) -> String {
    let number = line
        .split_once(" = ")
        .and_then(|(key, text)| Some((key, text.parse::<f64>().ok()?)));
    match number {
        Some((key, number)) if number != 0.0 && !(1e-2..1e5).contains(&number.abs()) => {
            format!("{key} = {number:e}")
        }
        _ => line.to_owned(),
    }
}

/// Returns the allowed range of the number at `key`; `None` for an unknown key.
pub fn range(key: &str) -> Option<Range> {
    let (table, key) = key.rsplit_once('.')?;
    let table = match table.split_once('.') {
        Some(("valves", _)) => "valves",
        _ => table,
    };
    parameters::ranges()
        .find(|(in_table, range)| *in_table == table && range.key == key)
        .map(|(_, range)| range)
}

fn find<'a>(tree: &'a toml::Table, key: &str) -> Option<&'a toml::Value> {
    match key.split_once('.') {
        Some((table, key)) => find(tree.get(table)?.as_table()?, key),
        None => tree.get(key),
    }
}

fn find_mut<'a>(tree: &'a mut toml::Table, key: &str) -> Option<&'a mut toml::Value> {
    match key.split_once('.') {
        Some((table, key)) => find_mut(tree.get_mut(table)?.as_table_mut()?, key),
        None => tree.get_mut(key),
    }
}

/// Collects the keys of all numbers; `prefix` is the path of `tree`.
fn collect_keys(tree: &toml::Table, prefix: &str, keys: &mut Vec<String>) {
    for (key, value) in tree {
        let key = format!("{prefix}{key}");
        match value {
            toml::Value::Table(table) => collect_keys(table, &format!("{key}."), keys),
            toml::Value::Float(_) => keys.push(key),
            _ => {}
        }
    }
}
