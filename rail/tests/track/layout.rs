//! Layouts against closed forms; invalid layouts are rejected.

use dashpot_rail::track::{Layout, Part, Place, TrackError};

const STRAIGHT: Part = Part::Straight { length_m: 50.0 };
const TRANSITION: Part = Part::Transition { length_m: 60.0 };
const LEFT: Part = Part::Circular {
    radius_m: -300.0,
    length_m: 100.0,
    cant_m: -0.15,
};
const RIGHT: Part = Part::Circular {
    radius_m: 300.0,
    length_m: 100.0,
    cant_m: 0.15,
};

#[test]
fn curvature_and_cant_are_linear_in_transitions_and_constant_elsewhere() {
    let layout = Layout::new(&[STRAIGHT, TRANSITION, LEFT, TRANSITION, RIGHT]).unwrap();
    assert_eq!(layout.length_m(), 370.0);
    // Distance, curvature times 300 m (equal to cant over 0.15 m), and its change per 60 m.
    for (distance_m, share, change) in [
        (-1e6, 0.0, 0.0),
        (0.0, 0.0, 0.0),
        (49.9, 0.0, 0.0),
        (65.0, -0.25, -1.0),
        (110.0, -1.0, 0.0),
        (200.0, -1.0, 0.0),
        (210.0, -1.0, 2.0),
        (240.0, 0.0, 2.0),
        (255.0, 0.5, 2.0),
        (270.0, 1.0, 0.0),
        (1e6, 1.0, 0.0),
    ] {
        let found = layout.at(distance_m);
        let expected = [
            share / 300.0,
            change / (300.0 * 60.0),
            share * 0.15,
            change * 0.15 / 60.0,
        ];
        let found = [
            found.curvature_per_m,
            found.curvature_rate_per_m2,
            found.cant_m,
            found.cant_slope,
        ];
        for (found, expected) in found.iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-15,
                "{distance_m}: {found} {expected}"
            );
        }
    }
    // Curvature and cant are continuous where parts meet.
    for joint_m in [50.0, 110.0, 210.0, 270.0] {
        let [before, behind] = [-1e-9, 1e-9].map(|step| layout.at(joint_m + step));
        assert!((before.curvature_per_m - behind.curvature_per_m).abs() < 1e-12);
        assert!((before.cant_m - behind.cant_m).abs() < 1e-10);
    }
}

#[test]
fn the_heading_is_the_integral_of_the_curvature() {
    let layout = Layout::new(&[STRAIGHT, TRANSITION, LEFT, TRANSITION, RIGHT]).unwrap();
    let step_m = 0.01;
    let mut integral = 0.0;
    for i in 0..40_000 {
        let distance_m = step_m * (f64::from(i) + 0.5);
        integral += step_m * layout.at(distance_m).curvature_per_m;
        let heading = layout.heading_rad(distance_m + 0.5 * step_m);
        assert!((heading - integral).abs() < 1e-9, "{distance_m}");
    }
    // A transition turns by half as much as a curve of the same length.
    let heading = layout.heading_rad(110.0);
    assert!((heading + 60.0 / (2.0 * 300.0)).abs() < 1e-15, "{heading}");
    assert_eq!(layout.heading_rad(-100.0), 0.0);
}

/// A clothoid of the length `L` shifts the circle of the radius `R` away from the straight by
/// `L^2 / (24 R) - L^4 / (2688 R^3)`. The offset of its own end from the straight is `L^2 / (6 R) - L^4 / (336 R^3)`.
#[test]
fn the_end_of_a_clothoid_has_the_offset_of_its_series() {
    let (length, radius): (f64, f64) = (60.0, 300.0);
    let parts = [STRAIGHT, TRANSITION, RIGHT];
    let layout = Layout::new(&parts).unwrap();
    let step_m = 1e-3;
    let offset_m: f64 = (0..60_000)
        .map(|i| layout.heading_rad(50.0 + step_m * (f64::from(i) + 0.5)))
        .map(|heading| step_m * heading.sin())
        .sum();
    let expected = length * length / (6.0 * radius) - length.powi(4) / (336.0 * radius.powi(3));
    assert!((offset_m - expected).abs() < 2e-6, "{offset_m} {expected}");
    let shift_m = offset_m - radius * (1.0 - layout.heading_rad(110.0).cos());
    let expected = length * length / (24.0 * radius) - length.powi(4) / (2688.0 * radius.powi(3));
    assert!((shift_m - expected).abs() < 2e-6, "{shift_m} {expected}");
}

/// The heading `s^2/(2 R L)` of a clothoid has the integral `s^3/(6 R L)`; the heading `h + s/R` of a curve has
/// `h s + s^2/(2 R)`.
#[test]
fn the_offset_is_the_integral_of_the_heading() {
    let layout = Layout::new(&[STRAIGHT, TRANSITION, LEFT, TRANSITION, RIGHT]).unwrap();
    let (length, radius) = (60.0, -300.0);
    let offset = |distance_m: f64| layout.course(distance_m).offset_m;
    let end_of_transition = length * length / (6.0 * radius);
    let heading = length / (2.0 * radius);
    let end_of_curve = end_of_transition + heading * 100.0 + 100.0 * 100.0 / (2.0 * radius);
    for (distance_m, expected) in [
        (-200.0, 0.0),
        (50.0, 0.0),
        (80.0, 30.0 * 30.0 * 30.0 / (6.0 * radius * length)),
        (110.0, end_of_transition),
        (
            150.0,
            end_of_transition + heading * 40.0 + 40.0 * 40.0 / (2.0 * radius),
        ),
        (210.0, end_of_curve),
    ] {
        let found = offset(distance_m);
        assert!(
            (found - expected).abs() < 1e-12,
            "{distance_m}: {found} {expected}"
        );
    }
    // From the left-hand to the right-hand curve and beyond, by the trapezoidal rule.
    let step_m = 0.01;
    let mut integral = end_of_curve;
    for i in 0..30_000 {
        let from_m = 210.0 + step_m * f64::from(i);
        let headings = layout.heading_rad(from_m) + layout.heading_rad(from_m + step_m);
        integral += 0.5 * step_m * headings;
        let found = offset(from_m + step_m);
        assert!(
            (found - integral).abs() < 1e-6,
            "{from_m}: {found} {integral}"
        );
    }
}

#[test]
fn a_curve_without_transition_and_cant_starts_abruptly() {
    let turnout = Part::Circular {
        radius_m: 190.0,
        length_m: 20.0,
        cant_m: 0.0,
    };
    let layout = Layout::new(&[STRAIGHT, turnout, STRAIGHT]).unwrap();
    assert_eq!(layout.at(50.0 - 1e-9).curvature_per_m, 0.0);
    assert_eq!(layout.at(50.0).curvature_per_m, 1.0 / 190.0);
    assert_eq!(layout.at(70.0).curvature_per_m, 0.0);
    assert!((layout.heading_rad(1000.0) - 20.0 / 190.0).abs() < 1e-15);
    assert_eq!(Layout::default().at(123.0), Default::default());
}

#[test]
fn errors_of_layouts_state_location_value_and_bounds() {
    let circular = |radius_m, cant_m| Part::Circular {
        radius_m,
        length_m: 100.0,
        cant_m,
    };
    let cases: [(&[Part], &str); 12] = [
        (&[], "the layout has no parts, allowed: one or more"),
        (
            &[STRAIGHT, Part::Straight { length_m: -1.0 }],
            "part 2 of the layout: length_m -1, allowed: 0.1 to 1000000",
        ),
        (
            &[Part::Straight { length_m: f64::NAN }],
            "part 1 of the layout: length_m NaN",
        ),
        (
            &[STRAIGHT, circular(0.0, 0.0)],
            "part 2 of the layout: magnitude of radius_m 0, allowed: 50 to 1000000",
        ),
        (&[circular(-49.0, 0.0)], "magnitude of radius_m 49"),
        (&[circular(f64::INFINITY, 0.0)], "magnitude of radius_m inf"),
        (
            &[circular(300.0, 0.31)],
            "cant_m (left rail above right rail) 0.31, allowed: -0.1 to 0.3",
        ),
        (
            &[circular(-300.0, 0.15)],
            "cant_m (left rail above right rail) 0.15, allowed: -0.3 to 0.1",
        ),
        (
            &[STRAIGHT, RIGHT],
            "part 2 of the layout: cant_m starts at 0.15, but the previous part ends at 0; put a transition",
        ),
        (
            &[STRAIGHT, TRANSITION],
            "part 2 of the layout: a transition must lie between two straight",
        ),
        (
            &[STRAIGHT, TRANSITION, TRANSITION, RIGHT],
            "part 2 of the layout: a transition must lie between two straight",
        ),
        (
            &[RIGHT, TRANSITION, RIGHT],
            "part 2 of the layout: a transition between parts of the same curvature and cant",
        ),
    ];
    for (parts, expected) in cases {
        let error = Layout::new(parts).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    let error = Layout::new(&[TRANSITION, RIGHT]).unwrap_err();
    let place = Place::Part(1);
    assert_eq!(error, TrackError::TransitionAtEnd { place });
}
