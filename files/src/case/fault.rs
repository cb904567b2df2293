//! Changes of dampers on the way.

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Law, VehicleParameters};

use super::CaseError;
use crate::{damper, vehicle};

/// A damper that becomes another while the vehicle runs.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Fault {
    /// When, s.
    pub time_s: f64,
    /// Name of the damper.
    pub damper: String,
    /// Its number among the elements of the vehicle.
    pub element: usize,
    /// What it is from then on.
    pub parameters: DamperParameters,
}

/// A fault in names.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultOptions {
    /// When, s.
    pub time_s: f64,
    /// One damper by its name and number, those of a name, or those along a direction.
    pub damper: String,
    /// What it becomes: a preset or a damper file; itself, changed by `overrides`, when not given.
    pub by: Option<String>,
    /// Overrides `table.key=value` of what it becomes.
    pub overrides: Vec<String>,
}

/// The faults by rising time, each of the dampers it names. A later one changes what an earlier one made.
pub(super) fn read(
    faults: &[FaultOptions],
    vehicle: &VehicleParameters,
    duration_s: f64,
) -> Result<Vec<Fault>, CaseError> {
    let mut order: Vec<(usize, &FaultOptions)> = faults.iter().enumerate().collect();
    order.sort_by(|a, b| a.1.time_s.total_cmp(&b.1.time_s));
    let mut read: Vec<Fault> = Vec::new();
    for (index, fault) in order {
        let wrong = |reason: String| CaseError::Fault {
            number: index + 1,
            reason,
        };
        if !(0.0..=duration_s).contains(&fault.time_s) {
            let time_s = fault.time_s;
            return Err(wrong(format!(
                "time_s {time_s}, allowed: 0 to {duration_s}"
            )));
        }
        if fault.by.is_none() && fault.overrides.is_empty() {
            return Err(wrong(
                "neither damper_file nor set: it changes nothing".into(),
            ));
        }
        for element in vehicle::called(vehicle, &fault.damper).map_err(wrong)? {
            let before = read.iter().rev().find(|before| before.element == element);
            let before = match (before, &vehicle.elements[element].law) {
                (Some(before), _) => &before.parameters,
                (None, Law::Damper { parameters, .. }) => parameters,
                (None, _) => continue,
            };
            let name = &vehicle.elements[element].name;
            let parameters = match &fault.by {
                Some(by) => damper::load(by, &fault.overrides),
                None => damper::change(name, before, &fault.overrides),
            };
            let parameters = parameters.map_err(|error| wrong(error.to_string()))?;
            read.push(Fault {
                time_s: fault.time_s,
                damper: name.clone(),
                element,
                parameters: DamperParameters::clone(&parameters),
            });
        }
    }
    Ok(read)
}
