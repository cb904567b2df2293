//! Overhanging points and folds: which points are removed, and which files are rejected.

use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::{self, MAX_FOLD_MM, ProfileError};

use crate::common::{EXACT, rail, rail_readings, text, wheel, wheel_readings};

#[test]
fn points_beyond_the_widest_point_of_a_rail_are_removed() {
    let good = rail_readings();
    let (expected, reading) = rail(&text(&good)).unwrap();
    assert_eq!((reading.points, reading.overhanging), (good.len(), 0));
    let widest = good[good.len() - 1].0;
    // Both sides extend down to the foot, which is wider than the head.
    let mut rows = good.clone();
    for (inward, z) in [
        (0.5, 37.0),
        (3.0, 38.0),
        (7.0, 40.0),
        (10.0, 42.0),
        (13.0, 45.5),
    ] {
        rows.push((widest - inward, z));
        rows.insert(0, (inward - widest, z));
    }
    rows.push((75.0, 170.0));
    rows.insert(0, (-75.0, 170.0));
    let (whole, reading) = rail(&text(&rows)).unwrap();
    assert_eq!(whole.points(), expected.points());
    assert_eq!((reading.points, reading.overhanging), (rows.len(), 12));
    let summary = reading.to_string();
    let part = format!("12 of {} points removed at the ends", rows.len());
    assert!(summary.contains(&part), "{summary}");
    rows.reverse();
    assert_eq!(rail(&text(&rows)).unwrap().0.points(), expected.points());
}

#[test]
fn back_and_face_of_a_wheel_are_removed() {
    let good = wheel_readings();
    let (expected, _) = wheel(&text(&good)).unwrap();
    let mut rows = good.clone();
    // The back extends further up than the flange extends down.
    for i in 0..12 {
        let up = f64::from(i) * 4.0;
        rows.insert(0, (-69.0 + 1e-3 * up, 12.0 - up));
        rows.push((60.0, -3.0 - up));
    }
    let (whole, reading) = wheel(&text(&rows)).unwrap();
    assert_eq!(whole.points(), expected.points());
    assert_eq!((reading.overhanging, reading.folded), (24, 0));
}

#[test]
fn a_small_fold_is_reduced_to_its_outer_points() {
    let good = rail_readings();
    // A burr on the field side protrudes 0.2 mm beyond the points below it.
    let burr = good.iter().position(|row| row.0 > 34.0).unwrap();
    let mut rows = good.clone();
    let (y, z) = rows[burr];
    rows.insert(burr + 1, (y + 0.2, z + 0.1));
    rows.insert(burr + 2, (y + 0.01, z + 0.2));
    let (profile, reading) = rail(&text(&rows)).unwrap();
    assert_eq!((reading.folded, reading.overhanging), (1, 0));
    assert!((reading.widest_fold_mm - 0.19).abs() < 1e-9, "{reading:?}");
    assert!(reading.to_string().contains("1 in folds of up to 0.190 mm"));
    let rises = |pair: &[_]| matches!(pair, [p, q] if position(p) < position(q));
    assert!(profile.points().windows(2).all(rises));
}

fn position(point: &dashpot_rail::profile::ProfilePoint) -> f64 {
    point.y_m
}

#[test]
fn a_wide_fold_is_rejected_where_the_curve_emerges() {
    let mut rows = rail_readings();
    let burr = rows.iter().position(|row| row.0 > 34.0).unwrap();
    let (y, z) = rows[burr];
    rows.insert(burr + 1, (y + MAX_FOLD_MM + 0.6, z + 0.1));
    let refused = rail(&text(&rows)).unwrap_err();
    let ProfileError::FoldedBack { line, fold_mm, .. } = refused else {
        panic!("{refused}");
    };
    // The first row is on line 3; the curve emerges behind the burr.
    assert!(line > burr as u64 + 4 && fold_mm > MAX_FOLD_MM, "{refused}");
}

#[test]
fn a_second_pass_over_the_surface_is_rejected() {
    let good = rail_readings();
    let mut twice = good.clone();
    twice.extend(good.iter().rev().skip(1).take(good.len() / 2));
    twice.push((38.0, 36.5));
    let refused = rail(&text(&twice)).unwrap_err();
    assert!(
        matches!(refused, ProfileError::FoldedBack { .. }),
        "{refused}"
    );
}

#[test]
fn a_vertical_side_ends_the_profile() {
    let mut rows = rail_readings();
    // A gauge face worn to the vertical, with measurement noise.
    rows.retain(|row| row.0 > -35.95);
    let (y, z) = rows[0];
    for i in 1..60 {
        let noise = 0.01 * f64::from(i % 3 - 1);
        rows.insert(0, (y + noise, z + 0.4 * f64::from(i)));
    }
    let (profile, reading) = measured::parse("rail.csv", &text(&rows), Body::Rail, &EXACT).unwrap();
    assert!(reading.overhanging > 40, "{reading:?}");
    let first = profile.points()[0];
    assert!(
        (first.y_m * 1e3 - y).abs() < 0.05,
        "{first:?}, expected {y}"
    );
    assert!(
        profile
            .points()
            .iter()
            .all(|point| point.angle_rad.cos() > 0.0)
    );
}

#[test]
fn a_gap_on_a_vertical_side_ends_the_profile() {
    let mut rows = rail_readings();
    rows.retain(|row| row.0 > -35.95);
    let (y, z) = rows[0];
    let good = rail(&text(&rows)).unwrap().0;
    // The measurement continues 12 mm further down, 0.01 mm further out.
    for i in 0..10 {
        rows.insert(0, (y - 0.01, z + 12.0 + 0.4 * f64::from(i)));
    }
    let (profile, reading) = rail(&text(&rows)).unwrap();
    assert_eq!((profile.points(), reading.overhanging), (good.points(), 10));
    // At 0.5 mm further out, part of the surface would be missing.
    rows.iter_mut().take(10).for_each(|row| row.0 -= 0.5);
    let refused = rail(&text(&rows)).unwrap_err();
    assert!(matches!(refused, ProfileError::Gap { .. }), "{refused}");
}
