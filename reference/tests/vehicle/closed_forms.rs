//! A curve without a transition excites a body on springs.

use dashpot_rail::vehicle::GRAVITY_M_PER_S2;
use dashpot_reference::vehicle::VehicleReference;

use crate::common::{
    CURVE_M, RADIUS, SPRINGS, X, Y, abrupt_curve, contact, on_track, springs_on_track, times,
};

const SPEED: f64 = 20.0;

/// Yaw: the frame rotates at `V/R`, so `psi = -V/(R w) sin w t`. Lateral and roll: a step of `-m V^2/R`. The weight
/// couples the two motions by `-m g/2`.
#[test]
fn free_oscillations_after_an_abrupt_curve() {
    let vehicle = on_track(springs_on_track());
    let contact = contact(0.4);
    let track = abrupt_curve();
    let start_s = CURVE_M / SPEED;
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, SPEED, 0.0).unwrap();
    let samples = reference.run(&times(0.013, 150), 1e-10).unwrap();

    let [kx, ky, kz] = SPRINGS.map(|stiffness| 4.0 * stiffness);
    let [m, ix, iz] = [30e3, 40e3, 900e3];
    let yaw_rate = ((kx * Y * Y + ky * X * X) / iz).sqrt();
    // The eigenvalues of [ky/m a; b kz y^2/ix].
    let (own, other) = (ky / m, kz * Y * Y / ix);
    let coupling = -0.5 * m * GRAVITY_M_PER_S2;
    let (mean, half) = (0.5 * (own + other), 0.5 * (own - other));
    let root = (half * half + coupling * coupling / (m * ix)).sqrt();
    let step = -SPEED * SPEED / RADIUS;
    let (mut largest, mut yaw_largest) = (0.0f64, 0.0f64);
    for sample in &samples {
        let t = (sample.time_s - start_s).max(0.0);
        let yaw = -SPEED / RADIUS / yaw_rate * (yaw_rate * t).sin();
        let part = |square: f64| (1.0 - (square.sqrt() * t).cos()) / square;
        let (slow, fast) = (part(mean - root), part(mean + root));
        // The shares of both modes in the lateral motion, and the roll of each mode.
        let share = 0.5 * (1.0 - half / root);
        let lateral = step * (share * slow + (1.0 - share) * fast);
        let roll = step * coupling / ix * (fast - slow) / (2.0 * root);
        let [found_y, _, found_roll, _, found_yaw] = sample.coordinates[0];
        assert!((found_y - lateral).abs() < 1e-9, "{found_y} {lateral}");
        assert!((found_roll - roll).abs() < 1e-9, "{found_roll} {roll}");
        assert!((found_yaw - yaw).abs() < 1e-9, "{found_yaw} {yaw}");
        largest = largest.max(roll.abs());
        yaw_largest = yaw_largest.max(yaw.abs());
    }
    assert!(largest > 1e-4 && yaw_largest > 1e-3);
}

#[test]
fn invalid_times_and_tolerances_are_refused() {
    let (vehicle, contact) = (on_track(springs_on_track()), contact(0.4));
    let track = crate::common::straight(vec![]);
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 20.0, 0.0).unwrap();
    for (times, tolerance) in [
        (vec![0.0, 0.1, 0.1], 1e-8),
        (vec![-0.1], 1e-8),
        (vec![f64::NAN], 1e-8),
        (vec![0.1], 0.0),
    ] {
        assert!(reference.run(&times, tolerance).is_err(), "{times:?}");
    }
    assert!(VehicleReference::new(&vehicle, &contact, &track, 0.0, 0.0).is_err());
}
