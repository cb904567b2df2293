//! Overrides of a vehicle's dampers.

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Law, VehicleParameters};

use super::dampers::find_dampers;
use super::error::VehicleFileError;
use crate::{damper, overrides};

/// Override `dampers.table.key=value`, split after `dampers`.
pub(super) struct DamperOverride<'a> {
    /// Direction or name of the dampers.
    dampers: &'a str,
    /// Override `table.key=value` to apply to each of them.
    change: &'a str,
}

/// Splits an override `dampers.table.key=value`; `None` for an override `part.key=value` of the vehicle file.
pub(super) fn split(assignment: &str) -> Option<DamperOverride<'_>> {
    let (keys, _) = assignment.split_once('=')?;
    let (dampers, path) = keys.split_once('.')?;
    path.contains('.').then(|| DamperOverride {
        dampers: dampers.trim(),
        change: &assignment[dampers.len() + 1..],
    })
}

/// Damper parameters before and after an override.
struct Changed {
    before: DamperParameters,
    after: DamperParameters,
}

/// Applies `dampers.table.key=value` to the dampers in a direction or with a name.
pub(super) fn apply(
    vehicle: &mut VehicleParameters,
    assignment: &str,
) -> Result<(), VehicleFileError> {
    let invalid = |reason: String| VehicleFileError::Override {
        assignment: assignment.to_owned(),
        reason,
    };
    overrides::parse(assignment).map_err(invalid)?;
    let Some(DamperOverride { dampers, change }) = split(assignment) else {
        return Err(invalid("it names no table of the damper".into()));
    };
    let change = [change.to_owned()];
    // Identical dampers are changed only once.
    let mut changed: Vec<Changed> = Vec::new();
    for element in find_dampers(vehicle, dampers).map_err(invalid)? {
        let Law::Damper { parameters, .. } = &mut vehicle.elements[element].law else {
            continue;
        };
        let known = changed.iter().find(|known| known.before == **parameters);
        let after = match known {
            Some(known) => known.after.clone(),
            None => {
                let after = damper::change(dampers, parameters, &change)
                    .map_err(|error| invalid(error.to_string()))?;
                let after = DamperParameters::clone(&after);
                changed.push(Changed {
                    before: DamperParameters::clone(parameters),
                    after: after.clone(),
                });
                after
            }
        };
        **parameters = after;
    }
    Ok(())
}
