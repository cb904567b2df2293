//! Vehicle files: TOML in SI units, unknown keys refused with the nearest one.

mod change;
mod dampers;
mod error;
mod replace;
mod replacement;
mod tables;

use std::path::PathBuf;

pub(crate) use dampers::called;
use dashpot_rail::vehicle::{Standstill, VehicleParameters};
pub use error::FORM;
pub use error::VehicleFileError;
pub use replacement::Replacement;
use tables::VehicleFile;

use crate::overrides::{self, explain, nearest};
use crate::shipped::{Found, Shipped};

/// Vehicles that ship with the program: name and file.
pub const VEHICLES: [(&str, &str); 2] = [
    (
        "locomotive",
        include_str!("../../data/vehicles/locomotive.toml"),
    ),
    ("coach", include_str!("../../data/vehicles/coach.toml")),
];

const SHIPPED: Shipped = Shipped {
    what: "vehicle",
    one: "vehicle",
    texts: &VEHICLES,
};

/// The vehicle called `name`: a shipped one, or the TOML file at that path, `-` being standard input; then each
/// `part.key=value` of `overrides` in order, where a part is a body, a wheelset, an element or a ride point of the file, and then each
/// `dampers.table.key=value`, which changes the dampers along vertical, lateral or longitudinal, or of a name.
///
/// # Errors
/// Neither vehicle nor readable file; text that is no TOML; unknown or missing keys; a damper that there is not; an override of
/// a part that there is not; parts that are no vehicle.
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

/// As [`load`], with dampers replaced before the overrides are applied.
///
/// # Errors
/// As [`load`]; a replacement of dampers that there are not, or by one that there is not.
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
    let found = SHIPPED.find::<VehicleFileError>(name)?;
    parse_in(&found, replacements, overrides)
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
    let found = Found {
        name: name.to_owned(),
        text: text.to_owned().into(),
        folder: PathBuf::new(),
    };
    parse_in(&found, &[], overrides)
}

fn parse_in(
    found: &Found,
    replacements: &[Replacement],
    overrides: &[String],
) -> Result<VehicleParameters, VehicleFileError> {
    let Found { name, text, folder } = found;
    let in_text = |error: toml::de::Error| VehicleFileError::Text {
        name: name.clone(),
        message: explain(&error),
    };
    // Typed first, for errors that name line and column.
    let _: VehicleFile = toml::from_str(text).map_err(in_text)?;
    let mut tree: toml::Table = toml::from_str(text).map_err(in_text)?;
    dampers::name_files_from(folder, &mut tree);
    let replaced = replace::apply(&mut tree, replacements)?;
    let (of_dampers, of_parts): (Vec<_>, Vec<_>) = overrides
        .iter()
        .partition(|assignment| change::of_dampers(assignment).is_some());
    for assignment in of_parts {
        set(&mut tree, assignment)?;
    }
    let file: VehicleFile = tree
        .try_into()
        .map_err(|error| VehicleFileError::Overridden {
            name: name.clone(),
            message: explain(&error),
        })?;
    let mut vehicle = file.vehicle(&replaced, |part| located(name, text, part))?;
    for assignment in of_dampers {
        change::apply(&mut vehicle, assignment)?;
    }
    // What no equation can be made of is told with its line here.
    Standstill::new(&vehicle).map_err(|source| VehicleFileError::Vehicle {
        name: source
            .part()
            .map_or_else(|| name.clone(), |part| located(name, text, part)),
        source,
    })?;
    Ok(vehicle)
}

/// The file with the line of the part of that name; equal parts are called by their name and a number.
fn located(file: &str, text: &str, part: &str) -> String {
    let of_equals = part.rsplit_once(' ').map(|(name, _)| name);
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
    match line_of(part).or_else(|| line_of(of_equals?)) {
        Some(line) => format!("{file}:{}", line + 1),
        None => file.to_owned(),
    }
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
