//! Damper files and presets: TOML in SI units; unknown keys are errors that suggest a similar key.

mod error;
mod keyed;

use dashpot_core::CheckedParameters;
use dashpot_core::parameters::{
    DamperParameters, Element, Geometry, Hydraulics, Leakage, Limits, Mount, Oil, Orifice, Reduced,
    Relief, Reservoir, Seal, TwoChamber, Valves,
};
pub use error::FORM;
pub use error::{ContentError, DamperError};
pub use keyed::{KeyedParameters, range, text};
use serde::{Deserialize, Serialize};

use crate::overrides::{self, Override, explain};
use crate::shipped::{Found, Shipped};

/// Built-in presets: name and text.
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

/// Tables of a damper file: either `[reduced]` or the hydraulic tables, both with `[mount]` and `[limits]`.
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

/// Loads the damper called `name`: a preset, or the TOML file at that path (`-` for standard input). Then applies each
/// override `table.key=value` in order.
///
/// # Errors
/// Returns an error if there is no such preset or readable file, if the text is not TOML, for unknown, missing or
/// misplaced keys, for a value out of range, and for an invalid override.
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
    kind: "damper",
    built_in: "preset",
    texts: &PRESETS,
};

/// Parses the damper in `text`; error messages call it `name`.
///
/// # Errors
/// Same errors as [`load`].
pub fn parse(
    name: &str,
    text: &str,
    overrides: &[String],
) -> Result<CheckedParameters, DamperError> {
    let (name, in_text) = (name.to_owned(), |error| ContentError::Text(explain(&error)));
    // Parsed twice: as a tree to apply overrides to, and as typed data for errors with line and column.
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
            // The file is incomplete even without the overrides, so they are not the cause of the error.
            Err(_) => DamperError::Content { name, source },
        })
}

/// Applies each override `table.key=value` to a damper; error messages call it `name`.
///
/// # Errors
/// Returns an error for an invalid override, an unknown key or a value out of range.
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
    let mut tree = toml::Table::try_from(DamperFile::new(damper.clone()))
        .map_err(|error| in_tables(ContentError::Tables(error.to_string())))?;
    for assignment in overrides {
        set(&mut tree, assignment)?;
    }
    tree.try_into()
        .map_err(|error| ContentError::Tables(explain(&error)))
        .and_then(from_file)
        .map_err(in_tables)
}

/// Applies one override `table.key=value` with a TOML value.
fn set(tree: &mut toml::Table, assignment: &str) -> Result<(), DamperError> {
    let invalid = |reason: String| DamperError::Override {
        assignment: assignment.to_owned(),
        reason,
    };
    let Override { path, key, value } = overrides::parse(assignment).map_err(invalid)?;
    let mut table = tree;
    for key in path {
        table = table
            .entry(key)
            .or_insert_with(|| toml::Value::Table(toml::Table::new()))
            .as_table_mut()
            .ok_or_else(|| invalid(format!("`{key}` is not a table")))?;
    }
    table.insert(key.to_owned(), value);
    Ok(())
}

impl DamperFile {
    fn new(damper: DamperParameters) -> Self {
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
            // Unknown kind of damper: reading the text back reports the missing tables.
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
