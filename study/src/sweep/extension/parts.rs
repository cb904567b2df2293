//! Parts of a case by name, so that a message can name those that differ.

use std::collections::BTreeMap;
use std::fmt::Debug;

use crate::sweep::digest::Digest;
use dashpot_files::case::Case;
use dashpot_files::study::StudyFileError;

/// First character of a part that is a digest instead of a number.
pub const DIGEST: char = '#';

/// Values of the parts of a case: numbers as text, digests of everything else.
///
/// # Errors
/// The file of a measured irregularity cannot be read.
pub fn parts(case: &Case) -> Result<BTreeMap<String, String>, StudyFileError> {
    let Case {
        name: _,
        vehicle,
        track,
        speed_m_per_s,
        duration_s,
        start_m,
        friction,
        contact,
        normal_damping_s_per_m,
        step_s,
        push_m,
        rails,
        faults,
        events,
    } = case;
    let mut contact_digest = Digest::default();
    contact_digest.add_contact(contact);
    let mut irregularity = Digest::default();
    irregularity.add_irregularity(&track.irregularity)?;
    let layout = digest_of(&(&track.layout, &track.defects));
    let parts = [
        ("vehicle", digest_of(vehicle)),
        ("support of the rails", digest_of(rails)),
        ("faults", digest_of(faults)),
        ("events", digest_of(events)),
        ("layout of the track", layout),
        ("irregularity of the track", named(irregularity)),
        ("contact of wheels and rails", named(contact_digest)),
        ("speed_m_per_s", format!("{speed_m_per_s:?}")),
        ("duration_s", format!("{duration_s:?}")),
        ("start_m", format!("{start_m:?}")),
        ("friction", format!("{friction:?}")),
        ("step_s", format!("{step_s:?}")),
        ("push_m", format!("{push_m:?}")),
        (
            "normal_damping_s_per_m",
            format!("{normal_damping_s_per_m:?}"),
        ),
    ];
    Ok(parts.map(|(name, value)| (name.to_owned(), value)).into())
}

fn digest_of(value: &impl Debug) -> String {
    let mut digest = Digest::default();
    digest.add(value);
    named(digest)
}

fn named(digest: Digest) -> String {
    format!("{DIGEST}{}", digest.hexadecimal())
}
