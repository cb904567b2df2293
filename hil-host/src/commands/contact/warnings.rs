//! Warnings of `dashpot contact`, with remedies expressed as its options.

use dashpot_files::profile::{RailTilt, TiltBasis, rail_tilt};
use dashpot_rail::profile::{Body, Profile};
use dashpot_study::profile_ends::{End, EndContact, Side};
use serde::Serialize;

use super::profiles::Profiles;

/// Tilt of a rail profile in the axes of its file, as JSON.
#[derive(Serialize)]
pub(super) struct TiltReport {
    rail: String,
    tilt_rad: f64,
    uncertainty_rad: f64,
    /// True if laying the rail with the inclination tilts it twice.
    contains_inclination: bool,
}

/// Measures the tilt of every rail that was read from a file.
pub(super) fn tilts(profiles: &Profiles, inclination: f64) -> Vec<(TiltReport, Option<String>)> {
    let files = [Some(&profiles.rail), profiles.left_rail.as_ref()];
    files
        .into_iter()
        .flatten()
        .filter(|rail| rail.reading.is_some())
        .filter_map(|rail| Some((&rail.profile, rail_tilt(&rail.profile)?)))
        .map(|(rail, tilt)| {
            let contains_inclination = tilt.contains(inclination);
            let report = TiltReport {
                rail: rail.name().to_owned(),
                tilt_rad: tilt.tilt_rad,
                uncertainty_rad: tilt.uncertainty_rad,
                contains_inclination,
            };
            let warning = contains_inclination.then(|| laid_twice(rail, &tilt, inclination));
            (report, warning)
        })
        .collect()
}

fn laid_twice(rail: &Profile, tilt: &RailTilt, inclination: f64) -> String {
    let basis = match tilt.basis {
        TiltBasis::BothSides => "both sides of its head",
        TiltBasis::FieldSide => "the field side of its head, if that is 1:20 in the upright rail",
        TiltBasis::GaugeSide => "the gauge side of its head, if that is 1:20 in the upright rail",
        _ => "the top of its head",
    };
    format!(
        "rail {}: the file seems to contain the inclination already: it is tilted by {:.0} +- {:.0} mrad, measured \
         from {basis}; 1:{:.0}, which is {:.0} mrad, tilts it again. Use --inclination 0 if the file is in the axes of \
         the track",
        rail.name(),
        tilt.tilt_rad * 1e3,
        tilt.uncertainty_rad * 1e3,
        1.0 / inclination,
        inclination.atan() * 1e3
    )
}

/// Describes a contact at an end of a profile.
pub(super) fn end_contact(contact: &EndContact, name: &str) -> String {
    let side = match contact.side {
        Side::Left => "left",
        Side::Right => "right",
    };
    let (body, end) = match (contact.body(), contact.end) {
        (Body::Wheel, End::Inner) => ("wheel", "on the side of the flange"),
        (Body::Wheel, End::Outer) => ("wheel", "on the field side"),
        (Body::Rail, End::Inner) => ("rail", "on the gauge side"),
        (Body::Rail, End::Outer) => ("rail", "on the field side"),
    };
    format!(
        "{side} {body} {name}: at lateral shifts from {:.2} to {:.2} mm the contact reaches the last point of the \
         profile {end}: the profile ends too early, and the true contact may lie beyond it. Measure it farther to that \
         side, or do not use these shifts and the conicities of their amplitudes",
        contact.from_lateral_shift_m * 1e3,
        contact.to_lateral_shift_m * 1e3
    )
}
