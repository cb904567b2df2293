//! Faults: changes of dampers during a run.

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Law, VehicleParameters};

use super::CaseError;
use super::bounds::check_bounds;
use crate::{damper, vehicle};

/// Change of one damper during a run.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Fault {
    /// Time of the change, s.
    pub time_s: f64,
    /// Name of the damper.
    pub damper: String,
    /// Index of the damper among the vehicle's elements.
    pub element: usize,
    /// Parameters from then on.
    pub parameters: DamperParameters,
}

/// Fault entry as written in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultOptions {
    /// Time of the change, s.
    pub time_s: f64,
    /// Dampers to change: one by name and number, all of a name, or all in a direction.
    pub damper: String,
    /// Preset or damper file that replaces them; `None` keeps their parameters and applies `overrides` only.
    pub replacement: Option<String>,
    /// Overrides `table.key=value`, applied after the replacement.
    pub overrides: Vec<String>,
}

/// Resolves each fault entry into one fault for each damper that it changes, and sorts the faults by time. A later
/// fault of a damper builds on the earlier ones.
pub(super) fn resolve(
    faults: &[FaultOptions],
    vehicle: &VehicleParameters,
    duration_s: f64,
) -> Result<Vec<Fault>, CaseError> {
    let mut order: Vec<(usize, &FaultOptions)> = faults.iter().enumerate().collect();
    order.sort_by(|a, b| a.1.time_s.total_cmp(&b.1.time_s));
    let mut resolved: Vec<Fault> = Vec::new();
    for (index, fault) in order {
        let invalid = |reason: String| CaseError::Fault {
            number: index + 1,
            reason,
        };
        check_bounds("time_s", fault.time_s, [0.0, duration_s])
            .map_err(|error| invalid(error.to_string()))?;
        if fault.replacement.is_none() && fault.overrides.is_empty() {
            return Err(invalid("no effect without `damper_file` or `set`".into()));
        }
        for element in vehicle::find_dampers(vehicle, &fault.damper).map_err(invalid)? {
            let previous = resolved.iter().rev().find(|fault| fault.element == element);
            let before = match (previous, &vehicle.elements[element].law) {
                (Some(previous), _) => &previous.parameters,
                (None, Law::Damper { parameters, .. }) => parameters,
                (None, _) => continue,
            };
            let name = &vehicle.elements[element].name;
            let parameters = match &fault.replacement {
                Some(name) => damper::load(name, &fault.overrides),
                None => damper::change(name, before, &fault.overrides),
            };
            let parameters = parameters.map_err(|error| invalid(error.to_string()))?;
            resolved.push(Fault {
                time_s: fault.time_s,
                damper: name.clone(),
                element,
                parameters: DamperParameters::clone(&parameters),
            });
        }
    }
    Ok(resolved)
}
