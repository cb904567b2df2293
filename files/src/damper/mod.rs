//! Damper files and presets: TOML in SI units, unknown keys refused with the nearest one.

mod error;
mod keyed;

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{
    DamperParameters, Element, Geometry, Hydraulics, Leakage, Limits, Mount, Oil, Orifice, Reduced,
    Relief, Reservoir, Seal, TwoChamber, Valves,
};
pub use error::FORM;
pub use error::{ContentError, DamperError};
pub use keyed::{Keyed, range, text};
use serde::{Deserialize, Serialize};

use crate::overrides::{self, explain};
use crate::shipped::{Found, Shipped};

/// Presets that ship with the program: name and file.
pub const PRESETS: [(&str, &str); 5] = [
    ("paper", include_str!("../../data/dampers/paper.toml")),
    (
        "calibrated",
        include_str!("../../data/dampers/calibrated.toml"),
    ),
    (
        "in-service",
        include_str!("../../data/dampers/in-service.toml"),
    ),
    (
        "reduced-vertical",
        include_str!("../../data/dampers/reduced-vertical.toml"),
    ),
    (
        "reduced-lateral",
        include_str!("../../data/dampers/reduced-lateral.toml"),
    ),
];

/// The tables of a damper file. One with `[reduced]` has `[mount]` and `[limits]` beside it, one
/// without has the hydraulics.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct DamperFile {
    geometry: Option<Geometry>,
    orifice: Option<Orifice>,
    valves: Option<Valves>,
    leakage: Option<Leakage>,
    relief: Option<Relief>,
    reservoir: Option<Reservoir>,
    seal: Option<Seal>,
    two_chamber: Option<TwoChamber>,
    oil: Option<Oil>,
    reduced: Option<Reduced>,
    mount: Mount,
    #[serde(default)]
    limits: Limits,
}

/// The damper called `name`: a preset, or the TOML file at that path, `-` being standard input; then
/// each `table.key=value` of `overrides` in order.
///
/// # Errors
/// Neither preset nor readable file; text that is no TOML; unknown, missing or misplaced keys; a value
/// outside its range; an override without which the damper is good.
///
/// ```
/// let damper = dashpot_files::damper::load("paper", &["mount.clearance_m=1e-3".into()])?;
/// assert_eq!(damper.mount.clearance_m, 1e-3);
/// # Ok::<(), dashpot_files::damper::DamperError>(())
/// ```
pub fn load(name: &str, overrides: &[String]) -> Result<CheckedParameters, DamperError> {
    let Found { name, text, .. } = SHIPPED.find::<DamperError>(name)?;
    parse(&name, &text, overrides)
}

const SHIPPED: Shipped = Shipped {
    what: "damper",
    one: "preset",
    texts: &PRESETS,
};

/// The damper written in `text`; `name` stands for it in errors.
///
/// # Errors
/// As [`load`].
pub fn parse(
    name: &str,
    text: &str,
    overrides: &[String],
) -> Result<CheckedParameters, DamperError> {
    let (name, in_text) = (name.to_owned(), |error| ContentError::Text(explain(&error)));
    // Once as typed data for errors that name line and column, once as a tree to override.
    let mut tree: toml::Table = match toml::from_str(text) {
        Ok(tree) => tree,
        Err(error) => {
            let source = in_text(error);
            return Err(DamperError::Content { name, source });
        }
    };
    let plain = toml::from_str(text).map_err(in_text).and_then(from_file);
    if overrides.is_empty() {
        return plain.map_err(|source| DamperError::Content { name, source });
    }
    for assignment in overrides {
        set(&mut tree, assignment)?;
    }
    tree.try_into()
        .map_err(|error| ContentError::Tables(explain(&error)))
        .and_then(from_file)
        .map_err(|source| match plain {
            Ok(_) => DamperError::Overridden { name, source },
            // The overrides may complete a file; they are not to blame for what it lacks.
            Err(_) => DamperError::Content { name, source },
        })
}

/// A damper with each `table.key=value` of `overrides` applied; `name` stands for it in errors.
///
/// # Errors
/// An override that is not of that form, of a key that there is not, or of a value outside its range.
///
/// ```
/// use dashpot_files::damper;
/// let damper = damper::load("reduced-vertical", &[])?;
/// let worn = damper::change("worn", &damper, &["mount.clearance_m=3e-3".into()])?;
/// assert_eq!(worn.mount.clearance_m, 3e-3);
/// # Ok::<(), damper::DamperError>(())
/// ```
pub fn change(
    name: &str,
    damper: &DamperParameters,
    overrides: &[String],
) -> Result<CheckedParameters, DamperError> {
    let in_tables = |source| DamperError::Overridden {
        name: name.to_owned(),
        source,
    };
    let mut tree = toml::Table::try_from(DamperFile::of(damper.clone()))
        .map_err(|error| in_tables(ContentError::Tables(error.to_string())))?;
    for assignment in overrides {
        set(&mut tree, assignment)?;
    }
    tree.try_into()
        .map_err(|error| ContentError::Tables(explain(&error)))
        .and_then(from_file)
        .map_err(in_tables)
}

/// Applies `table.key=value`, the value written as in TOML.
fn set(tree: &mut toml::Table, assignment: &str) -> Result<(), DamperError> {
    let wrong = |reason: String| DamperError::Override {
        assignment: assignment.to_owned(),
        reason,
    };
    let (keys, last, value) = overrides::parse(assignment).map_err(wrong)?;
    let mut table = tree;
    for key in keys {
        table = table
            .entry(key)
            .or_insert_with(|| toml::Value::Table(toml::Table::new()))
            .as_table_mut()
            .ok_or_else(|| wrong(format!("`{key}` is not a table")))?;
    }
    table.insert(last.to_owned(), value);
    Ok(())
}

impl DamperFile {
    fn of(damper: DamperParameters) -> Self {
        let empty = Self {
            geometry: None,
            orifice: None,
            valves: None,
            leakage: None,
            relief: None,
            reservoir: None,
            seal: None,
            two_chamber: None,
            oil: None,
            reduced: None,
            mount: damper.mount,
            limits: damper.limits,
        };
        match damper.element {
            Element::Reduced(reduced) => Self {
                reduced: Some(reduced),
                ..empty
            },
            Element::Physical(hydraulics) => Self {
                geometry: Some(hydraulics.geometry),
                orifice: Some(hydraulics.orifice),
                valves: Some(hydraulics.valves),
                leakage: hydraulics.leakage,
                relief: hydraulics.relief,
                reservoir: hydraulics.reservoir,
                seal: hydraulics.seal,
                two_chamber: hydraulics.two_chamber,
                oil: Some(hydraulics.oil),
                ..empty
            },
            // Reading the file back reports the missing tables.
            _ => empty,
        }
    }
}

fn from_file(file: DamperFile) -> Result<CheckedParameters, ContentError> {
    let element = match file.reduced {
        Some(reduced) => {
            let hydraulic = [
                ("geometry", file.geometry.is_some()),
                ("orifice", file.orifice.is_some()),
                ("valves", file.valves.is_some()),
                ("leakage", file.leakage.is_some()),
                ("relief", file.relief.is_some()),
                ("reservoir", file.reservoir.is_some()),
                ("seal", file.seal.is_some()),
                ("two_chamber", file.two_chamber.is_some()),
                ("oil", file.oil.is_some()),
            ];
            if let Some((table, _)) = hydraulic.into_iter().find(|(_, present)| *present) {
                return Err(ContentError::BesideReduced { table });
            }
            Element::Reduced(reduced)
        }
        None => {
            let missing = |table| ContentError::Missing { table };
            let mut hydraulics = Hydraulics::new(
                file.geometry.ok_or_else(|| missing("geometry"))?,
                file.orifice.ok_or_else(|| missing("orifice"))?,
                file.valves.ok_or_else(|| missing("valves"))?,
                file.oil.ok_or_else(|| missing("oil"))?,
            );
            hydraulics.leakage = file.leakage;
            hydraulics.relief = file.relief;
            hydraulics.reservoir = file.reservoir;
            hydraulics.seal = file.seal;
            hydraulics.two_chamber = file.two_chamber;
            Element::Physical(hydraulics)
        }
    };
    let parameters = DamperParameters::new(element, file.mount).limits(file.limits);
    Ok(parameters.check()?)
}
