//! The running locomotive at the top of the demonstration's page.

use dashpot_live::Choice;
use dashpot_page::{Below, in_browser};
use dashpot_report::page::Parts;
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::ContactSetup;

use crate::commands::failure::{Failure, Outcome};

/// The locomotive on straight track, at a speed at which a worn yaw damper shows.
const CASE: &str = "straight-180";
const SPEED_KM_H: f64 = 160.0;

/// Puts the running locomotive above another page.
///
/// # Errors
/// None are known: the case ships.
pub(super) fn above(title: &str, parts: Parts) -> Outcome<String> {
    let choice = Choice {
        speed_km_h: Some(SPEED_KM_H),
        ..Choice::of(CASE)
    };
    let case = choice
        .case()
        .map_err(|error| Failure::new(error.to_string()))?;
    let setup = ContactSetup::of_case(&case).map_err(VehicleRunError::from);
    let tables = setup.and_then(|setup| {
        let pairs = setup.pairs().iter();
        let tables = pairs.map(|pair| Ok((pair.tables_file_name()?, pair.tables()?.to_bytes())));
        tables.collect::<Result<Vec<_>, VehicleRunError>>()
    });
    let tables = tables.map_err(|error| Failure::new(error.to_string()))?;
    Ok(in_browser(&choice, &tables, Some(Below { title, parts })))
}
