//! Removal of wear: the lost area, the smoothing, and what is refused.

use dashpot_rail::profile::{Body, Profile, s1002, uic60};
use dashpot_wear::{RemovalError, Wear, WearEstimate, WearGrid, WearLaw, removed};

use crate::laws::sliding;

/// Area between two profiles with about the same ends, m^2.
fn area_between_m2(old: &Profile, new: &Profile) -> f64 {
    // Shoelace formula over both curves, as one closed polygon.
    let there = old.points().iter();
    let back = new.points().iter().rev();
    let polygon: Vec<[f64; 2]> = there
        .chain(back)
        .map(|point| [point.y_m, point.z_m])
        .collect();
    let next = polygon.iter().cycle().skip(1);
    let doubled = polygon
        .iter()
        .zip(next)
        .map(|(p, q)| p[0] * q[1] - q[0] * p[1]);
    0.5 * doubled.sum::<f64>().abs()
}

/// Wear of up to `depth_m` at `y_m` on a profile.
fn worn(profile: &Profile, y_m: f64, depth_m: f64) -> WearEstimate {
    let mut wear = Wear::new(WearGrid::new(profile), WearLaw::default());
    wear.add(y_m, &sliding(1e-2), 1.0);
    let estimate = wear.of_rail(1.0);
    let factor = depth_m / estimate.max_depth_m;
    estimate.scaled(factor)
}

#[test]
fn the_profile_loses_the_area_of_the_wear() {
    let (wheel, rail) = (s1002::profile(), uic60::profile());
    // Tread, flange root (concave, R 13), flange; top, gauge corner (convex, R 13).
    let places = [
        (&wheel, Body::Wheel, [0.0, -0.033, -0.044]),
        (&rail, Body::Rail, [0.0, -0.02, -0.031]),
    ];
    for (profile, body, places) in places {
        for y_m in places {
            for smoothing_m in [0.0, 2e-3, 5e-3] {
                let wear = worn(profile, y_m, 0.5e-3);
                let new = removed(profile, body, &wear.clone().averaged(smoothing_m)).unwrap();
                let lost_m2 = area_between_m2(profile, &new);
                assert!(
                    (lost_m2 / wear.area_m2 - 1.0).abs() < 2e-3,
                    "{} {y_m} {smoothing_m}: {}",
                    profile.name(),
                    lost_m2 / wear.area_m2
                );
            }
        }
    }
}

#[test]
fn a_wheel_loses_height_and_so_does_a_rail() {
    let (wheel, rail) = (s1002::profile(), uic60::profile());
    let new = removed(&wheel, Body::Wheel, &worn(&wheel, 0.0, 0.5e-3)).unwrap();
    assert!(new.at(0.0).z_m < wheel.at(0.0).z_m - 0.4e-3);
    let new = removed(&rail, Body::Rail, &worn(&rail, 0.0, 0.5e-3)).unwrap();
    assert!(new.at(0.0).z_m > rail.at(0.0).z_m + 0.4e-3);
}

#[test]
fn no_wear_leaves_the_profile_as_it_is() {
    let wheel = s1002::profile();
    let wear = worn(&wheel, 0.0, 0.5e-3).scaled(0.0);
    let same = removed(&wheel, Body::Wheel, &wear.averaged(2e-3)).unwrap();
    assert_eq!(same.points(), wheel.points());
    // A nanometre moves no point by more than that.
    let wear = worn(&wheel, 0.0, 1e-9);
    let near = removed(&wheel, Body::Wheel, &wear.averaged(2e-3)).unwrap();
    for y_mm in -69..=59 {
        let y_m = 1e-3 * f64::from(y_mm);
        assert!(
            (near.at(y_m).z_m - wheel.at(y_m).z_m).abs() < 20e-9,
            "{y_mm}"
        );
    }
}

#[test]
fn two_halves_are_a_whole() {
    let rail = uic60::profile();
    let whole = removed(&rail, Body::Rail, &worn(&rail, 5e-3, 0.2e-3).averaged(2e-3)).unwrap();
    let half = removed(&rail, Body::Rail, &worn(&rail, 5e-3, 0.1e-3).averaged(2e-3)).unwrap();
    let both = removed(&half, Body::Rail, &worn(&half, 5e-3, 0.1e-3).averaged(2e-3)).unwrap();
    for y_mm in -30..=30 {
        let y_m = 1e-3 * f64::from(y_mm);
        assert!(
            (both.at(y_m).z_m - whole.at(y_m).z_m).abs() < 2e-6,
            "{y_mm}"
        );
    }
}

#[test]
fn wear_of_another_profile_and_wear_too_deep_are_refused() {
    let (wheel, rail) = (s1002::profile(), uic60::profile());
    let wear = worn(&rail, 0.0, 1e-4);
    assert!(matches!(
        removed(&wheel, Body::Wheel, &wear),
        Err(RemovalError::OtherProfile { .. })
    ));
    let deep = worn(&rail, -0.031, 6e-3);
    let error = removed(&rail, Body::Rail, &deep).unwrap_err();
    assert!(
        error.to_string().contains("allowed: at most 0.4"),
        "{error}"
    );
}

#[test]
fn an_average_keeps_the_area_and_lengths_without_sense_change_nothing() {
    let wheel = s1002::profile();
    for y_m in [0.0, -0.0695, 0.0599] {
        let wear = worn(&wheel, y_m, 1e-3);
        let sum = |wear: &WearEstimate| wear.cells.iter().map(|cell| cell.depth_m).sum::<f64>();
        for length_m in [1e-3, 5e-3, 1.0, f64::INFINITY] {
            let averaged = wear.clone().averaged(length_m);
            assert!(
                (sum(&averaged) / sum(&wear) - 1.0).abs() < 1e-9,
                "{length_m}"
            );
            assert!(averaged.max_depth_m < wear.max_depth_m);
        }
        for length_m in [0.0, 1e-4, -1.0, f64::NAN] {
            assert_eq!(wear.clone().averaged(length_m), wear, "{length_m}");
        }
    }
}
