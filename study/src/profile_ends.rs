//! Contacts at an end of a profile, beyond which the profile is unknown.

use std::array::from_fn;

use dashpot_rail::contact::{Pair, RigidContact};
use dashpot_rail::profile::{Body, Profile};
use serde::Serialize;

use crate::loaded_wheelset::LoadedShift;

/// Distance from an end at which a contact is counted, m: some samples of a profile.
const NEAR_M: f64 = 0.3e-3;

/// Side of a wheelset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// Left.
    Left,
    /// Right.
    Right,
}

/// End of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum End {
    /// The end at the track centre: the back of a flange, or the gauge side of a rail.
    Inner,
    /// The end on the field side.
    Outer,
}

/// Lateral shifts at which the contact of one wheel reaches an end of a profile: the true contact may lie beyond it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct EndContact {
    /// Side of the wheelset.
    pub side: Side,
    /// True for the profile of the wheel, false for that of the rail.
    pub is_wheel: bool,
    /// End of the profile.
    pub end: End,
    /// Position of this end in the axes of the profile (for a rail, of the laid rail: from the track centre), m.
    pub end_y_m: f64,
    /// Smallest shift, m.
    pub from_lateral_shift_m: f64,
    /// Greatest shift, m.
    pub to_lateral_shift_m: f64,
}

impl EndContact {
    /// The profile.
    pub fn body(&self) -> Body {
        if self.is_wheel {
            Body::Wheel
        } else {
            Body::Rail
        }
    }
}

/// A contact of one wheel.
struct Contact {
    lateral_shift_m: f64,
    wheel_m: [f64; 2],
    track_y_m: f64,
    /// Half of its width, m; zero for a rigid contact.
    half_width_m: f64,
}

/// Finds the contacts at the ends of profiles: those of the rigid wheelset, and those of the wheelset under load.
/// `sides` are the left pair (as its mirror image on the right side) and the right pair.
pub fn end_contacts(
    sides: [&Pair; 2],
    rigid: &[RigidContact],
    loaded: &[LoadedShift],
) -> Vec<EndContact> {
    let contacts: [Vec<Contact>; 2] = from_fn(|side| {
        let rigid = rigid.iter().map(|contact| {
            let point = &contact.sides[side];
            Contact {
                lateral_shift_m: contact.lateral_m,
                wheel_m: [point.wheel_y_m, point.wheel_z_m],
                track_y_m: point.track_y_m,
                half_width_m: 0.0,
            }
        });
        let radius_m = sides[side].installation().wheel_radius_m;
        let loaded = loaded.iter().flat_map(|shift| {
            let wheel = [&shift.left, &shift.right][side];
            let patches = wheel.iter().flat_map(|wheel| &wheel.patches);
            patches.map(|patch| Contact {
                lateral_shift_m: shift.lateral_shift_m,
                wheel_m: [patch.wheel_y_m, patch.rolling_radius_m - radius_m],
                track_y_m: patch.track_y_m,
                half_width_m: patch.semi_axis_across_m,
            })
        });
        rigid.chain(loaded).collect()
    });
    let mut found = Vec::new();
    for (side, pair) in sides.into_iter().enumerate() {
        for is_wheel in [true, false] {
            let profile = if is_wheel { pair.wheel() } else { pair.rail() };
            for end in [End::Inner, End::Outer] {
                found.extend(reached(&contacts[side], profile, is_wheel, end).map(
                    |[from_lateral_shift_m, to_lateral_shift_m]| EndContact {
                        side: [Side::Left, Side::Right][side],
                        is_wheel,
                        end,
                        end_y_m: point_at(profile, end)[0],
                        from_lateral_shift_m,
                        to_lateral_shift_m,
                    },
                ));
            }
        }
    }
    found
}

fn point_at(profile: &Profile, end: End) -> [f64; 2] {
    let points = profile.points();
    let point = match end {
        End::Inner => &points[0],
        End::Outer => &points[points.len() - 1],
    };
    [point.y_m, point.z_m]
}

/// Smallest and greatest shift of the contacts that reach an end.
fn reached(contacts: &[Contact], profile: &Profile, is_wheel: bool, end: End) -> Option<[f64; 2]> {
    let [y, z] = point_at(profile, end);
    let is_near = |contact: &&Contact| {
        let [contact_y, contact_z] = if is_wheel {
            contact.wheel_m
        } else {
            [contact.track_y_m, profile.at(contact.track_y_m).z_m]
        };
        libm::hypot(contact_y - y, contact_z - z) < contact.half_width_m + NEAR_M
    };
    let shifts = contacts
        .iter()
        .filter(is_near)
        .map(|contact| contact.lateral_shift_m);
    let range = shifts.fold([f64::MAX, f64::MIN], |[low, high], shift| {
        [low.min(shift), high.max(shift)]
    });
    (range[0] <= range[1]).then_some(range)
}
