//! Lookup of a damper of the vehicle.

use dashpot_core::DamperParameters;
use dashpot_files::case::Case;

use crate::commands::failure::{Failure, Outcome};

/// Name and parameters of a damper of the vehicle.
///
/// # Errors
/// The vehicle has no such damper.
pub(super) fn named_damper(case: &Case, damper: usize) -> Outcome<(&str, &DamperParameters)> {
    let element = case.vehicle.dampers().nth(damper);
    let named = element.and_then(|element| {
        let parameters = case.damper(&element.name)?;
        Some((element.name.as_str(), parameters))
    });
    named.ok_or_else(|| Failure::new(format!("the vehicle has no damper {damper}")))
}
