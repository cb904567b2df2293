//! Forces on a wheelset that no element holds, against Newton's and Euler's laws.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::track::{Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{
    Body, GRAVITY_M_PER_S2, Vehicle, VehicleParameters, VehicleState, Wheelset,
};

use crate::support::{contact, four_springs};

const WHEELSET_KG: f64 = 20e3;
const INERTIA_KG_M2: [f64; 3] = [2e3, 5e3, 3e3];
const AHEAD_M: f64 = 6.0;
const SPEED: f64 = 25.0;

/// A body that is held by the track, and a wheelset ahead of the vehicle's middle.
fn parameters() -> VehicleParameters {
    let wheelset = Wheelset::new("wheelset", WHEELSET_KG, INERTIA_KG_M2, 0.625);
    VehicleParameters::new("free wheelset")
        .with_bodies([Body::new("body", 20e3, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([wheelset.with_x_m(AHEAD_M)])
        .with_elements(four_springs("body", [250e3; 3], 0.0, [3.0, 1.0, 1.5]))
}

/// A transition of 60 m from straight track to a circle.
fn ramp(radius_m: f64, cant_m: f64) -> Track {
    let parts = [
        Part::Straight { length_m: 50.0 },
        Part::Transition { length_m: 60.0 },
        Part::Circular {
            radius_m,
            length_m: 100.0,
            cant_m,
        },
    ];
    let layout = Layout::new(&parts).unwrap();
    Track::new(layout, Irregularity::default(), vec![]).unwrap()
}

/// Speed divided by the rotation of the centred wheelset, m. Its creepage is the speed less that of the wheel's
/// surface, divided by the speed.
fn rolling_radius_m(straight: &VehicleState) -> f64 {
    let patches = straight.contacts()[0].wheels[1].loaded_patches();
    let main = patches.max_by(|a, b| a.load_n.total_cmp(&b.load_n));
    let main = main.unwrap();
    main.rolling_radius_m / (1.0 - main.creepage.longitudinal)
}

/// The wheelset spins forward, so its angular momentum points to the left, along the axle. The axle turns with the
/// track, which yaws and rolls; the moment of the rails has to turn the momentum too.
#[test]
fn contact_weight_and_gyroscopic_moments_accelerate_a_wheelset() {
    let vehicle = Vehicle::new(&parameters(), contact(5.0), 1e-3).unwrap();
    let radius_m = rolling_radius_m(&vehicle.at_rest(&Track::default(), 0.0, SPEED).unwrap());
    let (track, distance_m) = (ramp(300.0, 0.15), 70.0);
    let mut state = vehicle.at_rest(&track, distance_m, SPEED).unwrap();
    let [_, _, roll_rate, _, yaw_rate] = state.velocities()[1];
    let slope = 0.15 / 1.5 / 60.0;
    assert!(
        (roll_rate / (SPEED * slope) - 1.0).abs() < 1e-2,
        "{roll_rate}"
    );
    assert!(
        (yaw_rate / (SPEED / 300.0 * 26.0 / 60.0) - 1.0).abs() < 1e-9,
        "{yaw_rate}"
    );
    let displacement = [2e-3, 30e-6, 20e-6, 0.0, 4e-3];
    vehicle
        .displace(&mut state, &track, 1, displacement)
        .unwrap();
    let WheelsetForces {
        force_n: [_, fy, fz],
        moment_n_m: [mx, my, mz],
        ..
    } = state.contacts()[0];
    let momentum = INERTIA_KG_M2[1] * SPEED / radius_m;
    // The frame under the wheelset is turned against that of the middle of the vehicle, in which forces are summed.
    let roll = |distance_m: f64| ((distance_m - 50.0) * slope).asin();
    let turned = roll(distance_m + AHEAD_M) - roll(distance_m);
    let [_, _, roll, _, yaw] = displacement;
    let expected = [
        fy - turned * fz,
        fz + turned * fy + WHEELSET_KG * GRAVITY_M_PER_S2,
        mx - momentum * yaw_rate,
        // Along the axle.
        -yaw * mx + my + roll * mz,
        mz + momentum * roll_rate,
    ];
    // Each term matters.
    for term in [
        turned * fz,
        turned * fy,
        momentum * yaw_rate,
        momentum * roll_rate,
    ] {
        assert!(term.abs() > 1.0, "{term}");
    }
    assert!(
        (yaw * mx).abs() > 1.0 && (roll * mz).abs() > 1e-3,
        "{mx} {mz}"
    );
    let [i_roll, i_spin, i_yaw] = INERTIA_KG_M2;
    let inertia = [WHEELSET_KG, WHEELSET_KG, i_roll, i_spin, i_yaw];
    let found = state.acceleration(1);
    for i in 0..5 {
        let found = inertia[i] * found[i];
        assert!(
            (found - expected[i]).abs() < 1e-4,
            "{i}: {found} for {}",
            expected[i]
        );
    }
}

/// A wheelset that moves with the track's frame slides no more than on straight level track.
#[test]
fn a_cant_ramp_alone_does_not_make_the_wheels_slide() {
    let vehicle = Vehicle::new(&parameters(), contact(5.0), 1e-3).unwrap();
    let forces = |track: &Track| {
        let state = vehicle.at_rest(track, 70.0, SPEED).unwrap();
        let [left, right] = state.contacts()[0].wheels;
        (state.velocities()[1], [left.force_n, right.force_n])
    };
    let (_, level) = forces(&Track::default());
    // Almost straight.
    let (velocity, on_ramp) = forces(&ramp(1e6, 0.15));
    assert!(velocity[0] > 0.01 && velocity[2] > 0.02, "{velocity:?}");
    for (found, expected) in on_ramp.iter().flatten().zip(level.iter().flatten()) {
        assert!((found - expected).abs() < 20.0, "{on_ramp:?} {level:?}");
    }
}

/// The contact is a spring with the stiffness `3/2 N/penetration` and a dashpot with `beta N`, so a small bounce loses
/// energy at the rate `c/m`.
#[test]
fn normal_damping_stops_the_bounce_of_a_wheelset() {
    const BETA_S_PER_M: f64 = 5.0;
    const TICKS: usize = 400;
    let (step_s, displacement_m) = (0.1e-3, 2e-6);
    let left_over = |beta: f64| {
        let vehicle = Vehicle::new(&parameters(), contact(beta), step_s).unwrap();
        let track = Track::default();
        let mut state = vehicle.at_rest(&track, 0.0, SPEED).unwrap();
        let wheels = &state.contacts()[0].wheels;
        let patches = wheels.iter().flat_map(|wheel| wheel.loaded_patches());
        let stiffness: f64 = patches
            .map(|patch| 1.5 * patch.load_n / patch.penetration_m)
            .sum();
        vehicle
            .displace(&mut state, &track, 1, [0.0, displacement_m, 0.0, 0.0, 0.0])
            .unwrap();
        for _ in 0..TICKS {
            vehicle.step(&mut state, &track);
        }
        let (z, v) = (state.coordinates()[1][1], state.velocities()[1][1]);
        (z * z + v * v * WHEELSET_KG / stiffness) / (displacement_m * displacement_m)
    };
    let damping = BETA_S_PER_M * WHEELSET_KG * GRAVITY_M_PER_S2;
    let expected = (-damping / WHEELSET_KG * step_s * TICKS as f64).exp();
    let found = left_over(BETA_S_PER_M);
    assert!(
        (found / expected - 1.0).abs() < 0.1,
        "{found} for {expected}"
    );
    let undamped = left_over(0.0);
    assert!((undamped - 1.0).abs() < 0.1, "{undamped}");
}
