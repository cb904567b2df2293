//! The live page: served to viewers, or in a file in which the vehicle runs by itself.

use dashpot_live::Choice;
use dashpot_page::Below;
use dashpot_server::Page;
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::ContactSetup;

use crate::commands::failure::{Failure, Outcome};

/// The page that viewers of a vehicle get, and its content policy.
pub fn served(vehicle: &str) -> Page {
    let page = dashpot_page::of_server(vehicle);
    Page {
        html: page.html,
        // A page cannot forbid by itself that another one frames it, and clicks on it.
        policy: format!("{}; frame-ancestors 'none'", page.policy),
    }
}

/// A page in which the vehicle runs by itself, with its contact tables; `below` follows it.
///
/// # Errors
/// The choice is no shipped case.
pub fn in_browser(choice: &Choice, below: Option<Below<'_>>) -> Outcome<String> {
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
    Ok(dashpot_page::in_browser(choice, &tables, below))
}
