//! The live page: served to viewers, or in a file in which the vehicle runs by itself.

use dashpot_live::Choice;
use dashpot_page::Below;
use dashpot_server::Page;
use dashpot_vehicle_run::VehicleRunError;
use dashpot_vehicle_run::contact::ContactSetup;

use crate::commands::failure::{Failure, Outcome};

/// What the page is made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setup {
    /// Name of the vehicle.
    pub vehicle: String,
}

/// What stands before the content policy in the page, and behind it.
const POLICY: [&str; 2] = ["http-equiv=\"Content-Security-Policy\" content=\"", "\""];

/// The page and its content policy.
pub fn document(setup: &Setup) -> Page {
    let html = dashpot_page::of_server(&setup.vehicle);
    let [before, behind] = POLICY;
    let policy = html
        .split_once(before)
        .and_then(|(_, rest)| rest.split_once(behind));
    // A page cannot forbid by itself that another one frames it, and clicks on it.
    let policy = policy.map_or("default-src 'none'", |(policy, _)| policy);
    let policy = format!("{policy}; frame-ancestors 'none'");
    Page { html, policy }
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
