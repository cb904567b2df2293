//! Parts of a case by name, so that a message can name those that differ.

use std::collections::BTreeMap;

use crate::sweep::digest::Digest;
use dashpot_files::case::Case;
use dashpot_files::study::StudyFileError;
use dashpot_files::track::IrregularityParameters;

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
    let digest_of = |text: String| {
        let mut digest = Digest::default();
        digest.add(&text);
        format!("{DIGEST}{}", digest.hexadecimal())
    };
    let contact_digest = {
        let mut digest = Digest::default();
        digest.add_contact(contact);
        format!("{DIGEST}{}", digest.hexadecimal())
    };
    let irregularity = match &track.irregularity {
        IrregularityParameters::Measured { file, options } => {
            let bytes = dashpot_files::input::read(file).map_err(StudyFileError::File)?;
            digest_of(format!("{options:?} {bytes:?}"))
        }
        other => digest_of(format!("{other:?}")),
    };
    let layout = digest_of(format!("{:?} {:?}", track.layout, track.defects));
    let parts = [
        ("vehicle", digest_of(format!("{vehicle:?}"))),
        ("support of the rails", digest_of(format!("{rails:?}"))),
        ("faults", digest_of(format!("{faults:?}"))),
        ("events", digest_of(format!("{events:?}"))),
        ("layout of the track", layout),
        ("irregularity of the track", irregularity),
        ("contact of wheels and rails", contact_digest),
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
