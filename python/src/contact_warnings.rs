//! Warnings of `dashpot.contact`, with remedies expressed as its arguments.

use dashpot_files::profile::rail_tilt;
use dashpot_rail::profile::Profile;
use dashpot_rail::profile::measured::Reading;
use dashpot_study::profile_ends::{End, EndContact, Side};

/// Warnings about rail files that contain the inclination which they get again.
pub fn laid_twice(rails: &[(Profile, Option<Reading>)], inclination: f64) -> Vec<String> {
    rails
        .iter()
        .filter(|(_, reading)| reading.is_some())
        .filter_map(|(rail, _)| Some((rail, rail_tilt(rail)?)))
        .filter(|(_, tilt)| tilt.contains(inclination))
        .map(|(rail, tilt)| {
            format!(
                "rail {}: the file seems to contain the inclination already: it is tilted by {:.0} +- {:.0} mrad; \
                 inclination={inclination} tilts it again. Use inclination=0 if the file is in the axes of the track",
                rail.name(),
                tilt.tilt_rad * 1e3,
                tilt.uncertainty_rad * 1e3
            )
        })
        .collect()
}

/// Warnings about contacts at the ends of profiles. If both sides are equal, the right one speaks for both.
pub fn at_ends(contacts: &[EndContact], is_symmetric: bool) -> Vec<String> {
    contacts
        .iter()
        .filter(|contact| !(is_symmetric && contact.side == Side::Left))
        .map(|contact| {
            let side = match contact.side {
                Side::Left => "left",
                Side::Right => "right",
            };
            let body = if contact.is_wheel { "wheel" } else { "rail" };
            let end = match contact.end {
                End::Inner => "towards the track centre",
                End::Outer => "on the field side",
            };
            format!(
                "{side} {body}: at lateral shifts from {:.5} to {:.5} m the contact reaches the last point of the \
                 profile {end}: the profile ends too early, and the true contact may lie beyond it",
                contact.from_lateral_shift_m, contact.to_lateral_shift_m
            )
        })
        .collect()
}
