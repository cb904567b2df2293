//! Profile files of GENSYS: two columns in mm, `#` for comments.
//!
//! Source: GENSYS, Users Manual for Program KPF, "Wheel profile input data" (gensys.se/doc_html/kpf.html): `Y` is
//! positive towards the track centre for both wheels, `Z` is positive down, and the origin is the nominal running
//! circle. The sign of `Y` of a rail could not be verified, so the user must state it.

use super::ProfileError;
use super::columns::rows;
use super::mirror::{Mirror, OrientedRows};
use crate::profile::Body;

/// Reads the points of `text`, in the axes of a profile.
pub(super) fn read(
    text: &str,
    body: Body,
    mirror: Option<Mirror>,
) -> Result<OrientedRows, ProfileError> {
    let mut rows = rows(text)?;
    match (body, mirror) {
        (Body::Wheel, mirror) => {
            mirror.unwrap_or_default().apply(&mut rows);
            Mirror::Y.apply(&mut rows);
        }
        (Body::Rail, Some(mirror)) => mirror.apply(&mut rows),
        (Body::Rail, None) => return Err(ProfileError::MirrorNotStated),
    }
    Ok(OrientedRows {
        rows,
        turned: false,
    })
}
