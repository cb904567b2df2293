//! Vehicle files: TOML in SI units; unknown keys are errors that suggest a similar key.

mod change;
mod dampers;
mod error;
mod replace;
mod replacement;
mod tables;

use std::path::PathBuf;

pub(crate) use dampers::find_dampers;
use dashpot_rail::vehicle::{Standstill, VehicleParameters};
pub use error::FORM;
pub use error::VehicleFileError;
pub use replacement::Replacement;
use tables::VehicleFile;

use crate::contact::{self, Wheels};
use crate::lines;
use crate::overrides::{self, Override, did_you_mean, explain};
use crate::shipped::{Found, Shipped};

/// Built-in vehicles: name and text.
pub const VEHICLES: [(&str, &str); 4] = [
    (
        "locomotive",
        include_str!("../../data/vehicles/locomotive.toml"),
    ),
    ("coach", include_str!("../../data/vehicles/coach.toml")),
    (
        "locomotive-without-yaw-dampers",
        include_str!("../../data/vehicles/locomotive-without-yaw-dampers.toml"),
    ),
    (
        "freight-wagon",
        include_str!("../../data/vehicles/freight-wagon.toml"),
    ),
];

const SHIPPED: Shipped = Shipped {
    kind: "vehicle",
    built_in: "vehicle",
    texts: &VEHICLES,
};

/// Loads the vehicle called `name`: a built-in one, or the TOML file at that path (`-` for standard input).
///
/// Then applies each override `part.key=value` in order, where a part is a body, wheelset, element or ride point of the
/// file, and after these each `dampers.table.key=value`, where `dampers` is `vertical`, `lateral`, `longitudinal` or a
/// name.
///
/// # Errors
/// Returns an error if there is no such vehicle or readable file, if the text is not TOML, for unknown or missing keys,
/// an unknown damper, an override of an unknown part, and invalid parts.
///
/// ```
/// let vehicle = dashpot_files::vehicle::load("locomotive", &["body.mass_kg=70e3".into()])?;
/// assert_eq!(vehicle.bodies[0].mass_kg, 70e3);
/// assert_eq!(vehicle.wheelsets.len(), 6);
///
/// let worn = dashpot_files::vehicle::load("locomotive", &["vertical.mount.clearance_m=3e-3".into()])?;
/// let is_worn = |law: &dashpot_rail::vehicle::Law| match law {
///     dashpot_rail::vehicle::Law::Damper { parameters, .. } => parameters.mount.clearance_m == 3e-3,
///     _ => false,
/// };
/// assert_eq!(worn.dampers().filter(|damper| is_worn(&damper.law)).count(), 8);
/// # Ok::<(), dashpot_files::vehicle::VehicleFileError>(())
/// ```
pub fn load(name: &str, overrides: &[String]) -> Result<VehicleParameters, VehicleFileError> {
    load_with(name, &[], overrides)
}

/// Same as [`load`], but replaces dampers before the overrides are applied.
///
/// # Errors
/// Same errors as [`load`]; also an error if the damper to replace or the new damper is unknown.
///
/// ```
/// use dashpot_files::vehicle::{self, Replacement};
/// use dashpot_rail::vehicle::Law;
/// let replaced: Replacement = "vertical=in-service".parse()?;
/// let vehicle = vehicle::load_with("locomotive", &[replaced], &[])?;
/// let damper = vehicle.elements.iter().find(|element| element.name == "front vertical damper 1").unwrap();
/// let Law::Damper { parameters, .. } = &damper.law else { unreachable!() };
/// assert_eq!(**parameters, *dashpot_files::damper::load("in-service", &[])?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn load_with(
    name: &str,
    replacements: &[Replacement],
    overrides: &[String],
) -> Result<VehicleParameters, VehicleFileError> {
    Ok(load_with_wheels(name, replacements, overrides)?.0)
}

/// Same as [`load_with`], but also loads the wheels, whose files are relative to the vehicle file.
///
/// # Errors
/// Same errors as [`load_with`]; also an error for an unknown or invalid wheel profile.
///
/// ```
/// let (vehicle, wheels) = dashpot_files::vehicle::load_with_wheels("coach", &[], &[])?;
/// assert_eq!(wheels.profiles.len(), vehicle.wheelsets.len());
/// assert_eq!(wheels.profiles[0][1].name(), "S1002");
/// # Ok::<(), dashpot_files::vehicle::VehicleFileError>(())
/// ```
pub fn load_with_wheels(
    name: &str,
    replacements: &[Replacement],
    overrides: &[String],
) -> Result<(VehicleParameters, Wheels), VehicleFileError> {
    let found = SHIPPED.find::<VehicleFileError>(name)?;
    parse_in(&found, replacements, overrides)
}

/// Parses the vehicle in `text`; error messages call it `name`.
///
/// # Errors
/// Same errors as [`load`].
pub fn parse(
    name: &str,
    text: &str,
    overrides: &[String],
) -> Result<VehicleParameters, VehicleFileError> {
    let found = Found {
        name: name.to_owned(),
        text: text.to_owned().into(),
        folder: PathBuf::new(),
    };
    Ok(parse_in(&found, &[], overrides)?.0)
}

fn parse_in(
    found: &Found,
    replacements: &[Replacement],
    overrides: &[String],
) -> Result<(VehicleParameters, Wheels), VehicleFileError> {
    let Found { name, text, folder } = found;
    let in_text = |error: toml::de::Error| VehicleFileError::Text {
        name: name.clone(),
        message: explain(&error),
    };
    // Parsed as typed data first, for errors with line and column.
    let _: VehicleFile = toml::from_str(text).map_err(in_text)?;
    let mut tree: toml::Table = toml::from_str(text).map_err(in_text)?;
    dampers::resolve_files(folder, &mut tree);
    let replaced = replace::apply(&mut tree, replacements)?;
    let (damper_overrides, part_overrides): (Vec<_>, Vec<_>) = overrides
        .iter()
        .partition(|assignment| change::split(assignment).is_some());
    for assignment in part_overrides {
        set(&mut tree, assignment)?;
    }
    let mut file: VehicleFile = tree
        .try_into()
        .map_err(|error| VehicleFileError::Overridden {
            name: name.clone(),
            message: explain(&error),
        })?;
    let wheels_table = std::mem::take(&mut file.contact);
    let mut vehicle = file.vehicle(&replaced, |part| locate(name, text, part))?;
    for assignment in damper_overrides {
        change::apply(&mut vehicle, assignment)?;
    }
    // Checks that the vehicle's equations can be set up; the line of an invalid part is known only here.
    Standstill::new(&vehicle).map_err(|source| VehicleFileError::Vehicle {
        name: source
            .part()
            .map_or_else(|| name.clone(), |part| locate(name, text, part)),
        source,
    })?;
    let wheels = wheels_table.wheels(&vehicle, folder);
    let wheels = wheels.map_err(|source| VehicleFileError::Contact {
        name: match lines::lines_of_keys(text, contact::TABLE).get(source.key) {
            Some(line) => format!("{name}:{line}"),
            None => name.clone(),
        },
        source,
    })?;
    Ok((vehicle, wheels))
}

/// Returns the file name with the line of a part. The name of one of several identical parts ends with a number, which
/// the file does not contain.
fn locate(file: &str, text: &str, part: &str) -> String {
    let without_number = part.rsplit_once(' ').map(|(name, _)| name);
    let line_of = |wanted: &str| {
        let is_name = |line: &str| {
            let value = line
                .trim()
                .strip_prefix("name")?
                .trim_start()
                .strip_prefix('=')?;
            let quoted = value.trim_start().get(1..)?;
            quoted
                .strip_prefix(wanted)?
                .starts_with(['"', '\''])
                .then_some(())
        };
        text.lines().position(|line| is_name(line).is_some())
    };
    match line_of(part).or_else(|| line_of(without_number?)) {
        Some(line) => format!("{file}:{}", line + 1),
        None => file.to_owned(),
    }
}

/// Applies the override `part.key=value` to the part of that name.
fn set(tree: &mut toml::Table, assignment: &str) -> Result<(), VehicleFileError> {
    let invalid = |reason: String| VehicleFileError::Override {
        assignment: assignment.to_owned(),
        reason,
    };
    let Override { path, key, value } = overrides::parse(assignment).map_err(invalid)?;
    let [part] = path[..] else {
        return Err(invalid("it does not name one part and one key".into()));
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
        let hint = did_you_mean(part, known.iter().map(String::as_str));
        return Err(invalid(format!("no part `{part}`{hint}")));
    };
    table.insert(key.to_owned(), value);
    Ok(())
}
