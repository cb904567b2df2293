//! Conversion of a Python dictionary to replacements for dampers of a vehicle.

use dashpot_core::DamperParameters;
use dashpot_files::vehicle::Replacement;
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::damper::Damper;
use crate::error::{Outcome, refuse};
use crate::overrides::path;

/// Reads a mapping from dampers of a vehicle to their replacements, each a name, a path or a `Damper`. Without one, the
/// result is empty.
pub fn replacements(given: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<Replacement>> {
    let Some(given) = given else {
        return Ok(Vec::new());
    };
    let Ok(given) = given.cast::<PyMapping>() else {
        return refuse(format!(
            "dampers: {}, allowed: a dictionary such as {{\"vertical\": \"in-service\"}}",
            given.get_type().name()?
        ));
    };
    let one = |item: Bound<'_, PyAny>| {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let dampers = key.str()?.to_string();
        let Ok(made) = value.cast::<Damper>() else {
            return Ok(Replacement::named(dampers, path(&value)?));
        };
        let parameters = DamperParameters::clone(&made.get().parameters);
        Ok(Replacement {
            dampers,
            damper: value.repr()?.to_string(),
            parameters: Some(Box::new(parameters)),
        })
    };
    given.items()?.iter().map(one).collect()
}
