//! Conversion of a dictionary of the contact to overrides of a case.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyDictMethods};

use crate::error::{Outcome, refuse};
use crate::overrides::{path, quoted, written};

/// Converts a dictionary with keys of the table `[contact]` of a case file to overrides `contact.key=value`; empty by
/// default.
pub fn contact_assignments(contact: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<String>> {
    let Some(contact) = contact.filter(|contact| !contact.is_none()) else {
        return Ok(Vec::new());
    };
    let Ok(contact) = contact.cast::<PyDict>() else {
        return refuse(format!(
            "contact: {}, allowed: a dictionary such as {{\"gauge_m\": 1.432}}",
            contact.get_type().name()?
        ));
    };
    let mut given = Vec::new();
    for (key, value) in contact.iter() {
        let assignment = format!("contact.{}={}", key.str()?, nested(&key, &value)?);
        given.push((!names_profile(&key.str()?.to_string()), assignment));
    }
    // A new profile resets the options for reading the previous one, so it comes before them.
    given.sort_by_key(|(is_later, _)| *is_later);
    Ok(given
        .into_iter()
        .map(|(_, assignment)| assignment)
        .collect())
}

fn names_profile(key: &str) -> bool {
    ["wheel", "rail", "left_rail", "right_rail"].contains(&key)
}

/// Writes a value as TOML: also a path, a sequence or a dictionary.
fn nested(key: &Bound<'_, PyAny>, value: &Bound<'_, PyAny>) -> Outcome<String> {
    if let Ok(table) = value.cast::<PyDict>() {
        let entry = |(name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            Ok(format!(
                "{} = {}",
                quoted(&name.str()?.to_cow()?),
                nested(key, &value)?
            ))
        };
        let entries: Vec<String> = table.iter().map(entry).collect::<Outcome<_>>()?;
        return Ok(format!("{{ {} }}", entries.join(", ")));
    }
    if value.hasattr("__fspath__")? {
        return Ok(quoted(&path(value)?));
    }
    let is_text = value.is_instance_of::<pyo3::types::PyString>();
    if !is_text && value.len().is_ok() {
        let items = value.try_iter()?;
        let items = items
            .map(|item| nested(key, &item?))
            .collect::<Outcome<Vec<_>>>()?;
        return Ok(format!("[{}]", items.join(", ")));
    }
    written(key, value)
}
