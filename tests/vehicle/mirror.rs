//! A left-hand curve is the mirror image of a right-hand curve.

use dashpot_rail::vehicle::Vehicle;

use crate::support::{contact, curve, locomotive, run};

#[test]
fn a_curve_to_the_left_mirrors_one_to_the_right() {
    let vehicle = Vehicle::new(&locomotive(), contact(5.0), 1e-3).unwrap();
    let of = |radius: f64| {
        let track = curve(radius);
        let mut state = vehicle.at_rest(&track, 0.0, 70.0 / 3.6).unwrap();
        run(&vehicle, &mut state, &track, 8.0);
        state
    };
    let (right, left) = (of(300.0), of(-300.0));
    assert!(right.coordinates()[3][0] < -5e-3);
    const MIRRORED: [f64; 5] = [-1.0, 1.0, -1.0, 1.0, -1.0];
    for (right, left) in right.coordinates().iter().zip(left.coordinates()) {
        for (i, sign) in MIRRORED.into_iter().enumerate() {
            assert!(
                (right[i] - sign * left[i]).abs() < 1e-10,
                "{right:?} {left:?}"
            );
        }
    }
    for (right, left) in right.contacts().iter().zip(left.contacts()) {
        assert!((right.wheels[0].force_n[2] - left.wheels[1].force_n[2]).abs() < 1.0);
        assert!((right.force_n[1] + left.force_n[1]).abs() < 1.0);
    }
}
