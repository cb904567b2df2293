//! Vehicle files: TOML in SI units, unknown keys refused with the nearest one.

mod error;
mod tables;

use std::path::Path;

use dashpot_rail::vehicle::VehicleParameters;
pub(crate) use error::FORM;
pub use error::VehicleFileError;
use tables::VehicleFile;

use crate::files::input;
use crate::files::overrides::{self, explain, nearest};

/// Vehicles that ship with the program: name and file.
pub const VEHICLES: [(&str, &str); 1] = [(
    "locomotive",
    include_str!("../../../../data/vehicles/locomotive.toml"),
)];

/// The vehicle called `name`: a shipped one, or the TOML file at that path, `-` being standard input; then each
/// `part.key=value` of `overrides` in order, where a part is a body, a wheelset or an element of the file.
///
/// # Errors
/// Neither vehicle nor readable file; text that is no TOML; unknown or missing keys; a damper that there is not; an override of
/// a part that there is not.
///
/// ```
/// let vehicle = dashpot_hil::files::vehicle::load("locomotive", &["body.mass_kg=70e3".into()])?;
/// assert_eq!(vehicle.bodies[0].mass_kg, 70e3);
/// assert_eq!(vehicle.wheelsets.len(), 6);
/// # Ok::<(), dashpot_hil::files::vehicle::VehicleFileError>(())
/// ```
pub fn load(name: &str, overrides: &[String]) -> Result<VehicleParameters, VehicleFileError> {
    let path = Path::new(name);
    if let Some((_, text)) = VEHICLES.iter().find(|(vehicle, _)| *vehicle == name) {
        return parse(name, text, overrides);
    }
    if !input::is_file_name(path) && !path.exists() {
        let names = VEHICLES.map(|(vehicle, _)| vehicle);
        return Err(VehicleFileError::Unknown {
            hint: nearest(name, names.into_iter()),
            vehicles: names.join(", "),
            name: name.to_owned(),
        });
    }
    let text = input::read_text(path)?;
    parse(&input::name(path).to_string_lossy(), &text, overrides)
}

/// The vehicle written in `text`; `name` stands for it in errors.
///
/// # Errors
/// As [`load`].
pub fn parse(
    name: &str,
    text: &str,
    overrides: &[String],
) -> Result<VehicleParameters, VehicleFileError> {
    let in_text = |error: toml::de::Error| VehicleFileError::Text {
        name: name.to_owned(),
        message: explain(&error),
    };
    // Typed first, for errors that name line and column.
    let plain: VehicleFile = toml::from_str(text).map_err(in_text)?;
    if overrides.is_empty() {
        return plain.vehicle(name);
    }
    let mut tree: toml::Table = toml::from_str(text).map_err(in_text)?;
    for assignment in overrides {
        set(&mut tree, assignment)?;
    }
    let file: VehicleFile = tree
        .try_into()
        .map_err(|error| VehicleFileError::Overridden {
            name: name.to_owned(),
            message: explain(&error),
        })?;
    file.vehicle(name)
}

/// Applies `part.key=value` to the part of that name.
fn set(tree: &mut toml::Table, assignment: &str) -> Result<(), VehicleFileError> {
    let wrong = |reason: String| VehicleFileError::Override {
        assignment: assignment.to_owned(),
        reason,
    };
    let (path, key, value) = overrides::parse(assignment).map_err(wrong)?;
    let [part] = path[..] else {
        return Err(wrong("one part and one key".into()));
    };
    let name_of = |table: &toml::Value| Some(table.get("name")?.as_str()?.to_owned());
    let parts = |tree: &toml::Table| -> Vec<String> {
        let arrays = tree.values().filter_map(toml::Value::as_array);
        arrays.flatten().filter_map(name_of).collect()
    };
    let known = parts(tree);
    let found = tree
        .iter_mut()
        .filter_map(|(_, array)| array.as_array_mut())
        .flatten()
        .find(|table| name_of(table).as_deref() == Some(part))
        .and_then(toml::Value::as_table_mut);
    let Some(table) = found else {
        let hint = nearest(part, known.iter().map(String::as_str));
        return Err(wrong(format!("no part `{part}`{hint}")));
    };
    table.insert(key.to_owned(), value);
    Ok(())
}
