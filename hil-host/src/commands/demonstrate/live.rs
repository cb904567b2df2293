//! The running locomotive at the top of the demonstration's page.

use dashpot_live::Choice;
use dashpot_page::Below;
use dashpot_report::page::Parts;

use crate::commands::failure::Outcome;
use crate::commands::live::page::in_browser;

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
    in_browser(&choice, Some(Below { title, parts }))
}
