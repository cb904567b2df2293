//! Defects against closed forms; invalid defects are rejected.

use dashpot_rail::track::{Defect, Irregularity, Layout, RailDeviation, Rails, Track};

fn track(defects: Vec<Defect>) -> Track {
    Track::new(Layout::default(), Irregularity::default(), defects).unwrap()
}

const DIP: Defect = Defect::CosineDip {
    rails: Rails::Left,
    start_m: 10.0,
    length_m: 2.0,
    depth_m: 6e-3,
};
const BUMP: Defect = Defect::AlignmentBump {
    rails: Rails::Right,
    start_m: 10.0,
    length_m: 8.0,
    offset_m: -5e-3,
};
const KINK: Defect = Defect::AlignmentKink {
    rails: Rails::Both,
    start_m: 30.0,
    length_m: 10.0,
    offset_m: 8e-3,
    rounding_m: 0.5,
};
const TWIST: Defect = Defect::Twist {
    start_m: 50.0,
    base_m: 3.0,
    plateau_m: 4.0,
    cross_level_m: 12e-3,
    rounding_m: 0.2,
};

#[test]
fn a_dip_has_its_depth_in_the_middle_on_one_rail() {
    let track = track(vec![DIP]);
    for (distance_m, depth_m) in [
        (9.9, 0.0),
        (10.0, 0.0),
        (10.5, 3e-3),
        (11.0, 6e-3),
        (11.5, 3e-3),
        (12.0, 0.0),
    ] {
        let [left, right] = track.rails(distance_m);
        assert!((left.vertical_m - depth_m).abs() < 1e-16, "{distance_m}");
        assert_eq!(right, RailDeviation::default());
    }
    let slope = track.rails(10.5)[0].vertical_slope;
    assert!((slope - 6e-3 * std::f64::consts::PI / 2.0).abs() < 1e-16);
}

#[test]
fn a_bump_is_lateral_and_on_one_rail() {
    let track = track(vec![BUMP]);
    let [left, right] = track.rails(14.0);
    assert_eq!(left, RailDeviation::default());
    assert!((right.lateral_m + 5e-3).abs() < 1e-16 && right.vertical_m == 0.0);
}

#[test]
fn a_kink_is_a_triangle_with_rounded_corners() {
    let track = track(vec![KINK]);
    let lateral = |distance_m| track.rails(distance_m)[0].lateral_m;
    let slope = |distance_m| track.rails(distance_m)[0].lateral_slope;
    assert_eq!(track.rails(35.3)[0], track.rails(35.3)[1]);
    // Straight lines outside the roundings: 8 mm over 5 m.
    for (distance_m, expected_m) in [
        (29.7, 0.0),
        (32.0, 3.2e-3),
        (34.0, 6.4e-3),
        (37.5, 4e-3),
        (40.3, 0.0),
    ] {
        assert!(
            (lateral(distance_m) - expected_m).abs() < 1e-16,
            "{distance_m}"
        );
    }
    assert!((slope(32.0) - 1.6e-3).abs() < 1e-16 && (slope(38.0) + 1.6e-3).abs() < 1e-16);
    // The rounding reduces the offset in the middle by offset x rounding / (2 length). At the ends the deviation is an
    // eighth of the rounding times the slope, and the slope is halved.
    assert!((lateral(35.0) - (8e-3 - 8e-3 * 0.5 / 20.0)).abs() < 1e-16);
    assert!((lateral(30.0) - 1.6e-3 * 0.5 / 8.0).abs() < 1e-16);
    assert!(slope(35.0).abs() < 1e-16 && (slope(30.0) - 0.8e-3).abs() < 1e-16);
}

#[test]
fn a_twist_raises_the_left_rail_and_lowers_the_right_one() {
    let track = track(vec![TWIST]);
    for (distance_m, cross_level_m, twist) in [
        (49.8, 0.0, 0.0),
        // At a corner: the slope is half the twist, the value an eighth of the rounding times the twist.
        (50.0, 1e-4, 2e-3),
        (51.5, 6e-3, 4e-3),
        (53.0, 12e-3 - 1e-4, 2e-3),
        (54.0, 12e-3, 0.0),
        (56.5, 12e-3, 0.0),
        (57.0, 12e-3 - 1e-4, -2e-3),
        (58.0, 8e-3, -4e-3),
        (60.0, 1e-4, -2e-3),
        (60.05, 0.25e-4, -1e-3),
        (60.2, 0.0, 0.0),
    ] {
        let [left, right] = track.rails(distance_m);
        assert!(
            (left.vertical_m + 0.5 * cross_level_m).abs() < 1e-15,
            "{distance_m}"
        );
        assert!(
            (right.vertical_m - 0.5 * cross_level_m).abs() < 1e-15,
            "{distance_m}"
        );
        assert!(
            (right.vertical_slope - left.vertical_slope - twist).abs() < 1e-15,
            "{distance_m}"
        );
        assert_eq!(left.lateral_m, 0.0);
    }
}

/// Between neighbouring samples the deviation changes by the mean slope times the step. It therefore cannot jump
/// between them.
#[test]
fn deviations_are_continuous_everywhere() {
    let step_m = 1e-3;
    for defect in [DIP, BUMP, KINK, TWIST] {
        let mut before = defect.at(0.0);
        for i in 1..=70_000 {
            let distance_m = f64::from(i) * step_m;
            let here = defect.at(distance_m);
            for (a, b) in before.iter().zip(&here) {
                let vertical = 0.5 * step_m * (a.vertical_slope + b.vertical_slope);
                let lateral = 0.5 * step_m * (a.lateral_slope + b.lateral_slope);
                assert!(
                    (b.vertical_m - a.vertical_m - vertical).abs() < 1e-8,
                    "{defect:?} {distance_m}"
                );
                assert!(
                    (b.lateral_m - a.lateral_m - lateral).abs() < 1e-8,
                    "{defect:?} {distance_m}"
                );
            }
            before = here;
        }
    }
}

#[test]
fn rails_are_exact_before_and_after_a_defect() {
    // The corners of these lengths add up to zero only approximately.
    let kink = Defect::AlignmentKink {
        rails: Rails::Both,
        start_m: 30.1,
        length_m: 9.7,
        offset_m: 8e-3,
        rounding_m: 0.5,
    };
    let twist = Defect::Twist {
        start_m: 50.3,
        base_m: 2.7,
        plateau_m: 4.1,
        cross_level_m: 12e-3,
        rounding_m: 0.2,
    };
    for (defect, ends_m) in [(kink, [29.84, 40.06]), (twist, [50.19, 59.91])] {
        let track = track(vec![defect]);
        for i in 0..1000 {
            let away_m = 0.37 * f64::from(i);
            for distance_m in [ends_m[0] - away_m, ends_m[1] + away_m] {
                assert_eq!(track.rails(distance_m), [RailDeviation::default(); 2]);
            }
        }
    }
}

#[test]
fn slopes_are_the_derivatives_of_the_deviations() {
    let step_m = 1e-5;
    for defect in [DIP, BUMP, KINK, TWIST] {
        let mut largest: f64 = 0.0;
        for i in 0..70_000 {
            let distance_m = f64::from(i) * 1e-3 + 0.37e-3;
            let [before, here, behind] =
                [-1.0, 0.0, 1.0].map(|k| defect.at(distance_m + k * step_m));
            for side in 0..2 {
                let (a, b, c) = (&before[side], &here[side], &behind[side]);
                let vertical = (c.vertical_m - a.vertical_m) / (2.0 * step_m);
                let lateral = (c.lateral_m - a.lateral_m) / (2.0 * step_m);
                // At the end of a rounding the difference quotient is off by a quarter of the step times the bend.
                assert!(
                    (b.vertical_slope - vertical).abs() < 2e-7,
                    "{defect:?} {distance_m}"
                );
                assert!(
                    (b.lateral_slope - lateral).abs() < 2e-7,
                    "{defect:?} {distance_m}"
                );
                largest = largest
                    .max(b.vertical_slope.abs())
                    .max(b.lateral_slope.abs());
            }
        }
        assert!(largest > 1e-3, "{defect:?} is outside the samples");
    }
}

#[test]
fn defects_add_up() {
    let both = track(vec![DIP, BUMP, DIP]);
    let [left, right] = both.rails(11.0);
    assert_eq!(left.vertical_m, 12e-3);
    assert_eq!(right.lateral_m, BUMP.at(11.0)[1].lateral_m);
    assert_eq!(both.defects().len(), 3);
}

#[test]
fn errors_of_defects_state_location_value_and_bounds() {
    let dip = |length_m, depth_m| Defect::CosineDip {
        rails: Rails::Both,
        start_m: 0.0,
        length_m,
        depth_m,
    };
    let kink = |rounding_m| Defect::AlignmentKink {
        rails: Rails::Both,
        start_m: 0.0,
        length_m: 10.0,
        offset_m: 1e-3,
        rounding_m,
    };
    let twist = |base_m, plateau_m, rounding_m| Defect::Twist {
        start_m: 0.0,
        base_m,
        plateau_m,
        cross_level_m: 1e-3,
        rounding_m,
    };
    let bump = Defect::AlignmentBump {
        rails: Rails::Left,
        start_m: f64::NAN,
        length_m: 1.0,
        offset_m: 0.0,
    };
    for (defect, expected) in [
        (
            dip(0.0, 1e-3),
            "defect 2: length_m 0, allowed: 0.05 to 1000",
        ),
        (dip(1.0, 4.0), "defect 2: depth_m 4, allowed: -0.2 to 0.2"),
        (
            bump,
            "defect 2: start_m NaN, allowed: -10000000 to 10000000",
        ),
        (kink(0.0), "defect 2: rounding_m 0, allowed: 0.001 to 5"),
        (kink(5.1), "defect 2: rounding_m 5.1, allowed: 0.001 to 5"),
        (twist(-3.0, 1.0, 0.1), "defect 2: base_m -3, allowed"),
        (twist(3.0, 0.0, 0.1), "defect 2: plateau_m 0, allowed"),
        (
            twist(3.0, 1.0, 1.1),
            "defect 2: rounding_m 1.1, allowed: 0.001 to 1",
        ),
    ] {
        let track = Track::new(
            Layout::default(),
            Irregularity::default(),
            vec![DIP, defect],
        );
        let error = track.unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
}
