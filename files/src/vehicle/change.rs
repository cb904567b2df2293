//! Values of a vehicle's dampers changed.

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Law, VehicleParameters};

use super::dampers::called;
use super::error::VehicleFileError;
use crate::{damper, overrides};

/// The dampers and the override `table.key=value` of `dampers.table.key=value`; none of `part.key=value`, which is of the vehicle's file.
pub(super) fn of_dampers(assignment: &str) -> Option<(&str, &str)> {
    let (keys, _) = assignment.split_once('=')?;
    let (dampers, path) = keys.split_once('.')?;
    path.contains('.')
        .then(|| (dampers.trim(), &assignment[dampers.len() + 1..]))
}

/// Applies `dampers.table.key=value` to the dampers of a direction or of a name.
pub(super) fn apply(
    vehicle: &mut VehicleParameters,
    assignment: &str,
) -> Result<(), VehicleFileError> {
    let wrong = |reason: String| VehicleFileError::Override {
        assignment: assignment.to_owned(),
        reason,
    };
    overrides::parse(assignment).map_err(wrong)?;
    let Some((which, change)) = of_dampers(assignment) else {
        return Err(wrong("no table of a damper".into()));
    };
    let change = [change.to_owned()];
    // Equal dampers stay equal; each is changed once.
    let mut changed: Vec<[DamperParameters; 2]> = Vec::new();
    for element in called(vehicle, which).map_err(wrong)? {
        let Law::Damper { parameters, .. } = &mut vehicle.elements[element].law else {
            continue;
        };
        let known = changed.iter().find(|[before, _]| *before == **parameters);
        let now = match known {
            Some([_, now]) => now.clone(),
            None => {
                let now = damper::change(which, parameters, &change)
                    .map_err(|error| wrong(error.to_string()))?;
                let now = DamperParameters::clone(&now);
                changed.push([DamperParameters::clone(parameters), now.clone()]);
                now
            }
        };
        **parameters = now;
    }
    Ok(())
}
