//! Profiles compared with their definitions and with figures of the standards; rejection of invalid points.

use dashpot_rail::contact::{Installation, Pair};
use dashpot_rail::profile::{CurveError, Profile, s1002, uic60};

#[test]
fn s1002_sections_join() {
    // The rounding of section C's ten-digit coefficients adds up to 7e-5 mm at -26 and 2.1e-4 mm at -35. The other
    // joints are given to nine decimals and meet within a tenth of a nanometre.
    let rounding = |joint: f64| match joint {
        -26.0 => 7e-5,
        -35.0 => 2.1e-4,
        _ => 1e-7,
    };
    for (section, joint) in s1002::JOINTS_MM[..7].iter().enumerate() {
        let gap = s1002::section_mm(section, *joint) - s1002::section_mm(section + 1, *joint);
        assert!(gap.abs() < rounding(*joint), "joint {joint}: gap {gap} mm");
        let slope = |k: usize| {
            (s1002::section_mm(k, joint + 1e-4) - s1002::section_mm(k, joint - 1e-4)) / 2e-4
        };
        let bend = slope(section) - slope(section + 1);
        assert!(bend.abs() < 2e-4, "joint {joint}: slopes differ by {bend}");
    }
    // EN 13715: flange height 28 mm over the datum, tip 55 mm from it, flange thickness 32.5 mm at 10 mm depth.
    assert!((s1002::depth_mm(-55.0) - 28.0).abs() < 1e-9);
    assert!(s1002::depth_mm(0.0).abs() < 1e-12);
    let at_ten = (-4000..-3000)
        .map(|i| f64::from(i) * 0.01)
        .find(|&s| s1002::depth_mm(s) < 10.0)
        .unwrap();
    assert!((70.0 + at_ten - 32.5).abs() < 0.02, "{at_ten}");
}

#[test]
fn uic60_joints_lie_where_the_standard_says() {
    for (y, depth) in [(10.499_79, 0.183_80), (25.988_03, 2.253_20)] {
        let arc = (0..4_000_000)
            .map(|i| f64::from(i) * 1e-5)
            .find(|&arc| uic60::position_mm(arc)[0] >= y)
            .unwrap();
        let position = uic60::position_mm(arc);
        assert!(
            (position[1] - depth).abs() < 1e-5,
            "{position:?} for {depth}"
        );
    }
    // EN 13674-1: the head is 72 mm wide at the end of R 13, 14.3 mm down.
    let side = uic60::position_mm(10.502_0 + 15.7 + 19.0);
    let width = 2.0 * (side[0] - (side[1] - 14.26) / 20.0);
    assert!((width - 72.0).abs() < 2e-3, "{width}");
}

#[test]
fn splines_follow_the_definitions_with_their_curvatures() {
    let wheel = s1002::profile();
    for i in -6900..6000 {
        let s = f64::from(i) * 0.01;
        let off = wheel.at(s * 1e-3).z_m * 1e3 - s1002::depth_mm(s);
        // The error of linear interpolation between samples 0.1 mm apart is h^2 / 8 R, more on the steep back of the
        // flange.
        assert!(off.abs() < 2e-3, "{s}: {off} mm");
    }
    for sample in wheel.points() {
        let off = sample.z_m * 1e3 - s1002::depth_mm(sample.y_m * 1e3);
        assert!(
            off.abs() < 1e-4 || sample.y_m < -0.068,
            "{sample:?}: {off} mm"
        );
    }
    let radius = |profile: &Profile, y: f64| 1e3 / profile.at(y * 1e-3).curvature_per_m;
    for (profile, y, expected) in [
        (&wheel, 45.0, f64::INFINITY),
        (&wheel, -37.0, 13.0),
        (&wheel, -45.0, -20.0),
        (&wheel, -58.0, -12.0),
        (&uic60::profile(), 0.0, 300.0),
        (&uic60::profile(), -7.0, 300.0),
        (&uic60::profile(), 18.0, 80.0),
        (&uic60::profile(), -31.0, 13.0),
    ] {
        let curvature = 1.0 / radius(profile, y) - 1.0 / expected;
        assert!(
            curvature.abs() < 2e-4 / 13.0,
            "at {y}: {}",
            radius(profile, y)
        );
    }
}

#[test]
fn invalid_installations_are_rejected() {
    for (installation, part) in [
        (
            Installation::default().with_gauge_m(1.0),
            "gauge minus back-to-back",
        ),
        (
            Installation::default().with_wheel_radius_m(f64::NAN),
            "wheel radius",
        ),
        (Installation::default().with_inclination(0.5), "inclination"),
    ] {
        let message = Pair::standard(installation).unwrap_err().to_string();
        assert!(
            message.contains(part) && message.contains("allowed"),
            "{message}"
        );
    }
}

#[test]
fn invalid_points_are_rejected() {
    let arc = |scale: f64| -> Vec<[f64; 2]> {
        let y = (0..50).map(|i| f64::from(i) * scale);
        y.map(|y| [y, 10.0 * y * y]).collect()
    };
    let refused = |points: &[[f64; 2]], smoothing_m| {
        Profile::through("arc", points, smoothing_m).unwrap_err()
    };
    let good = arc(1e-3);
    assert_eq!(
        refused(&good[..2], 0.0),
        CurveError::TooFewPoints { found: 2 }
    );
    let mut back = good.clone();
    back[7][0] = back[6][0];
    assert!(matches!(
        refused(&back, 0.0),
        CurveError::Point { index: 7, .. }
    ));
    let mut nan = good.clone();
    nan[0][1] = f64::NAN;
    assert!(matches!(
        refused(&nan, 0.0),
        CurveError::Point { index: 0, .. }
    ));
    // Millimetres instead of metres.
    assert!(matches!(
        refused(&arc(1.0), 0.0),
        CurveError::TooLong { .. }
    ));
    for smoothing_m in [-1e-3, f64::NAN] {
        assert!(matches!(
            refused(&good, smoothing_m),
            CurveError::Smoothing { .. }
        ));
    }
}
