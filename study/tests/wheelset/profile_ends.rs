//! Contacts at the ends of profiles that are too short.

use dashpot_rail::contact::{Installation, Pair};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};
use dashpot_study::profile_ends::{End, EndContact, Side, end_contacts};
use dashpot_study::wheelset_geometry::WheelsetGeometry;

/// The part of a profile within a lateral range, mm.
fn cut(profile: &Profile, range_mm: [f64; 2]) -> Profile {
    let points: Vec<[f64; 2]> = profile
        .points()
        .iter()
        .map(|p| [p.y_m, p.z_m])
        .filter(|[y, _]| (range_mm[0]..=range_mm[1]).contains(&(1e3 * y)))
        .collect();
    Profile::through(profile.name(), &points, 0.0).unwrap()
}

fn ends(wheel: Profile, rail: &Profile) -> Vec<EndContact> {
    let pair = Pair::new(wheel, rail, Installation::default()).unwrap();
    let geometry = WheelsetGeometry::new([&pair, &pair]).unwrap();
    end_contacts([&pair, &pair], &geometry.contacts, &[])
}

#[test]
fn complete_profiles_are_not_touched_at_their_ends() {
    assert_eq!(ends(s1002::profile(), &uic60::profile()), []);
}

#[test]
fn a_wheel_that_ends_on_its_tread_is_named() {
    // Centred, S1002 touches UIC 60 3 mm from its tread datum; shifted by a millimetre, 6.5 mm from it.
    let found = ends(cut(&s1002::profile(), [-69.0, 6.0]), &uic60::profile());
    assert_eq!(found.len(), 2, "{found:?}");
    for contact in found {
        assert_eq!((contact.body(), contact.end), (Body::Wheel, End::Outer));
        assert!((contact.end_y_m - 6e-3).abs() < 0.2e-3);
        // The right wheel reaches its field side when the wheelset shifts to the left.
        let shift_m = [contact.from_lateral_shift_m, contact.to_lateral_shift_m];
        if contact.side == Side::Right {
            assert!(
                shift_m[0] < -11e-3 && (-3e-3..-0.1e-3).contains(&shift_m[1]),
                "{shift_m:?}"
            );
        } else {
            assert!(
                shift_m[1] > 11e-3 && (0.1e-3..3e-3).contains(&shift_m[0]),
                "{shift_m:?}"
            );
        }
    }
}

#[test]
fn a_rail_that_ends_on_its_top_is_named() {
    let found = ends(s1002::profile(), &cut(&uic60::profile(), [-36.9, 2.0]));
    assert_eq!(found.len(), 2, "{found:?}");
    for contact in found {
        assert_eq!((contact.body(), contact.end), (Body::Rail, End::Outer));
    }
}
