//! Wheels, rails and friction of a vehicle on a track: the tables `[contact]` of vehicle and case files.
//!
//! A vehicle file names the profiles of its wheels ([`Wheels`]); a case file names the rails, gauge, inclination and
//! friction, and may replace the wheels ([`ContactOptions`]). [`ContactParameters`] is the result of both.

mod choice;
mod error;
mod options;
mod parameters;
mod rail_friction;
mod shared_profile;
mod wheels;

pub use error::{ContactError, ContactReason};
pub use options::{ContactOptions, OtherWheel, Side};
pub use parameters::ContactParameters;
pub use shared_profile::SharedProfile;
pub use wheels::Wheels;
pub(crate) use wheels::WheelsTable;

use crate::overrides;

/// Name of the table in vehicle and case files, and of its part in overrides.
pub const TABLE: &str = "contact";

/// Returns the key of an override `contact.key=value`.
fn key_of(assignment: &str) -> Option<&str> {
    let (path, _) = assignment.split_once('=')?;
    let (table, key) = path.trim().split_once('.')?;
    (table == TABLE).then_some(key)
}

/// Separates the overrides of the contact, `contact.key=value`, from those of the vehicle, and applies the former to
/// `options`. Returns the latter.
///
/// # Errors
/// Returns the first override that cannot be applied, and the reason.
///
/// ```
/// use dashpot_files::contact::{self, ContactOptions};
/// let mut options = ContactOptions::default();
/// let overrides = ["body.mass_kg=70e3", "contact.gauge_m=1.43"].map(String::from);
/// let of_vehicle = contact::apply_overrides(&mut options, &overrides).unwrap();
/// assert_eq!(options.gauge_m, Some(1.43));
/// assert_eq!(of_vehicle, ["body.mass_kg=70e3"]);
/// ```
pub fn apply_overrides(
    options: &mut ContactOptions,
    assignments: &[String],
) -> Result<Vec<String>, (String, String)> {
    let mut others = Vec::new();
    for assignment in assignments {
        let Some(key) = key_of(assignment) else {
            others.push(assignment.clone());
            continue;
        };
        let parsed = overrides::parse(assignment);
        let applied = parsed.and_then(|parsed| options.set(key, parsed.value));
        applied.map_err(|reason| (assignment.clone(), reason))?;
    }
    Ok(others)
}
