//! The shapes of the family of worn pairs.

use std::sync::OnceLock;

use dashpot_rail::contact::{Pair, SilhouettePoint, WheelPose};
use dashpot_rail::profile::{Body, Profile};
use dashpot_rail::profile::{s1002, uic60};
use dashpot_wear::procedure::{Collective, FAMILY, Member, Procedure, WornPair, family};

/// All members, computed once.
fn all() -> &'static [Member] {
    static ALL: OnceLock<Vec<Member>> = OnceLock::new();
    ALL.get_or_init(|| family().unwrap())
}

pub fn member(name: &str) -> &'static WornPair {
    &all()
        .iter()
        .find(|member| member.name == name)
        .unwrap()
        .pair
}

/// Depth lost at a lateral position, m.
fn lost_m(old: &Profile, new: &Profile, body: Body, y_m: f64) -> f64 {
    let rise = new.at(y_m).z_m - old.at(y_m).z_m;
    if body == Body::Wheel { -rise } else { rise }
}

/// Lateral position of the flange face 10 mm below the tread datum, m.
fn flange_m(wheel: &Profile) -> f64 {
    let face = wheel.points().windows(2);
    let mut crossings = face.filter(|pair| pair[0].z_m >= 10e-3 && pair[1].z_m < 10e-3);
    crossings.next_back().unwrap()[0].y_m
}

/// Width of the wheel that is within 50 um of the rail where they touch, mean over the shifts, m.
fn close_width_m(worn: &WornPair, shifts_mm: &[f64]) -> f64 {
    let installation = Procedure::default().installation;
    let pair = Pair::new(worn.wheel.clone(), &worn.rail, installation).unwrap();
    let widths = shifts_mm.iter().map(|shift_mm| {
        let pose = WheelPose {
            lateral_m: 1e-3 * shift_mm,
            ..WheelPose::default()
        };
        let mut silhouette = Vec::new();
        pair.silhouette(&pose, &mut silhouette);
        let heights = silhouette.iter().map(|point| point.interpenetration_m);
        let touch_m = heights.fold(f64::NEG_INFINITY, f64::max);
        let is_close = |point: &&SilhouettePoint| point.interpenetration_m > touch_m - 50e-6;
        1e-4 * silhouette.iter().filter(is_close).count() as f64
    });
    widths.sum::<f64>() / shifts_mm.len() as f64
}

#[test]
fn the_family_has_a_hollow_tread_a_thin_flange_and_conformal_shapes() {
    assert_eq!(all().iter().map(|one| one.name).collect::<Vec<_>>(), FAMILY);
    let (wheel, rail) = (s1002::profile(), uic60::profile());
    let on_wheel = |pair: &WornPair, y_m: f64| lost_m(&wheel, &pair.wheel, Body::Wheel, y_m);

    // A hollow tread: worn by 1.5 mm in the middle, not at the field side.
    let hollow = member("hollow tread");
    let deepest_m = (-30..=20)
        .map(|y_mm| on_wheel(hollow, 1e-3 * f64::from(y_mm)))
        .fold(0.0, f64::max);
    assert!((1.4e-3..1.7e-3).contains(&deepest_m), "{deepest_m}");
    assert!(on_wheel(hollow, 0.045).abs() < 5e-6);
    assert!(on_wheel(hollow, 0.02) - on_wheel(hollow, 0.04) > 1e-3);

    // A thin flange: the face has moved by 1 mm and more.
    let thin_m = flange_m(&member("thin flange").wheel) - flange_m(&wheel);
    assert!((-5e-3..-1e-3).contains(&thin_m), "{thin_m}");

    // Conformal shapes: more of the wheel is close to the rail, on the tread towards the flange and in its root.
    for (name, shifts_mm, factor) in [
        ("conformal", &[2.0, 3.0, 4.0][..], 1.4),
        ("flange worn", &[6.0, 7.0], 3.0),
    ] {
        let [new, worn] = ["new", name].map(|name| close_width_m(member(name), shifts_mm));
        assert!(worn > factor * new, "{name}: {worn} {new}");
    }
    let on_rail = lost_m(&rail, &member("worn to each other").rail, Body::Rail, -0.01);
    assert!(on_rail > 0.5e-3, "{on_rail}");

    // The mileage grows with the depth.
    let chain = ["new", "tread worn", "hollow tread"].map(member);
    assert!(chain.is_sorted_by(|a, b| a.distance_m < b.distance_m));
}

#[test]
fn the_procedure_is_deterministic_and_worn_pairs_go_on_wearing() {
    let new = WornPair::new(s1002::profile(), uic60::profile());
    let procedure = Procedure::default();
    let [first, second] = [(); 2].map(|()| {
        procedure
            .wear(&new, &Collective::straight(), 0.2e-3)
            .unwrap()
    });
    assert_eq!(first.wheel.points(), second.wheel.points());
    assert_eq!(first.rail.points(), second.rail.points());
    let later = procedure
        .wear(&first, &Collective::straight(), 0.3e-3)
        .unwrap();
    assert!(later.distance_m > first.distance_m);
    assert!((0.3e-3..0.46e-3).contains(&later.wheel_depth_m()));
}

#[test]
fn collectives_that_cannot_wear_are_refused() {
    let new = WornPair::new(s1002::profile(), uic60::profile());
    let procedure = Procedure::default();
    let error = procedure
        .wear(&new, &Collective::default(), 1e-4)
        .unwrap_err();
    assert!(error.to_string().contains("no wear"), "{error}");
    let too_much = Collective::default().with(
        dashpot_wear::procedure::Position::PressedN(1e9),
        0.0,
        100e3,
        1.0,
    );
    let error = procedure.wear(&new, &too_much, 1e-4).unwrap_err();
    assert!(error.to_string().contains("1000000000 N"), "{error}");
}
