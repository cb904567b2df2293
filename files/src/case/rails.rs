//! Support of the rails: the word or table `rails` of a case file, and its overrides.

use std::fmt;

use dashpot_rail::vehicle::RailSupport;
use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};

use crate::overrides::{explain, parse};

/// Key of the word or table in a case file, and of overrides `rails.key=value`.
pub(super) const KEY: &str = "rails";

/// Word for rails that do not give way.
const RIGID: &str = "rigid";
/// Word for rails with the default support.
const FLEXIBLE: &str = "flexible";

/// The value of `rails`; `None` for rigid rails.
pub(super) struct RailsValue(pub Option<RailSupport>);

/// Support of the rails; what is not given has the default value.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RailsTable {
    /// Mass in both directions.
    mass_kg: Option<f64>,
    lateral_mass_kg: Option<f64>,
    lateral_stiffness_n_per_m: Option<f64>,
    lateral_damping_n_s_per_m: Option<f64>,
    vertical_mass_kg: Option<f64>,
    vertical_stiffness_n_per_m: Option<f64>,
    vertical_damping_n_s_per_m: Option<f64>,
}

impl RailsTable {
    /// Replaces the values of `support` that the table has.
    fn replace(self, mut support: RailSupport) -> RailSupport {
        for (value, given) in [
            (
                &mut support.lateral_mass_kg,
                self.lateral_mass_kg.or(self.mass_kg),
            ),
            (
                &mut support.vertical_mass_kg,
                self.vertical_mass_kg.or(self.mass_kg),
            ),
            (
                &mut support.lateral_stiffness_n_per_m,
                self.lateral_stiffness_n_per_m,
            ),
            (
                &mut support.lateral_damping_n_s_per_m,
                self.lateral_damping_n_s_per_m,
            ),
            (
                &mut support.vertical_stiffness_n_per_m,
                self.vertical_stiffness_n_per_m,
            ),
            (
                &mut support.vertical_damping_n_s_per_m,
                self.vertical_damping_n_s_per_m,
            ),
        ] {
            if let Some(given) = given {
                *value = given;
            }
        }
        support
    }
}

/// Returns the support that a word means.
fn of_word(word: &str) -> Result<Option<RailSupport>, String> {
    match word {
        RIGID => Ok(None),
        FLEXIBLE => Ok(Some(RailSupport::BALLASTED)),
        _ => Err(format!(
            "rails {word:?}, allowed: \"{RIGID}\", \"{FLEXIBLE}\" or a table [{KEY}]"
        )),
    }
}

impl<'de> Deserialize<'de> for RailsValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WordOrTable;

        impl<'de> Visitor<'de> for WordOrTable {
            type Value = RailsValue;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "\"{RIGID}\", \"{FLEXIBLE}\" or a table [{KEY}]")
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<RailsValue, E> {
                of_word(word).map(RailsValue).map_err(E::custom)
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<RailsValue, A::Error> {
                let table = RailsTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(RailsValue(Some(table.replace(RailSupport::BALLASTED))))
            }
        }

        deserializer.deserialize_any(WordOrTable)
    }
}

/// Applies the overrides `rails=word` and `rails.key=value` among `assignments` and returns the others.
///
/// # Errors
/// The override that cannot be applied, and the reason.
pub(super) fn apply_overrides(
    rails: &mut Option<RailSupport>,
    assignments: &[String],
) -> Result<Vec<String>, (String, String)> {
    let mut others = Vec::new();
    for assignment in assignments {
        let failed = |reason: String| (assignment.clone(), reason);
        let (path, value) = assignment.split_once('=').unwrap_or((assignment, ""));
        if path.trim() == KEY {
            *rails = of_word(value.trim().trim_matches('"')).map_err(failed)?;
        } else if path.trim().starts_with("rails.") {
            let parsed = parse(assignment).map_err(failed)?;
            let table = toml::Table::from_iter([(parsed.key.to_owned(), parsed.value)]);
            let table = RailsTable::deserialize(table).map_err(|error| failed(explain(&error)))?;
            *rails = Some(table.replace(rails.unwrap_or(RailSupport::BALLASTED)));
        } else {
            others.push(assignment.clone());
        }
    }
    Ok(others)
}
