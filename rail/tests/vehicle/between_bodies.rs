//! Steps of two bodies with an element between them, against equations of motion written out by hand.

use dashpot_rail::vehicle::{Body, Element, End, GRAVITY_M_PER_S2, Law, VehicleParameters};

use crate::support::{four_springs, free_motion, free_wheelset, runge_kutta};

const MASS_KG: f64 = 10e3;
const ROLL_KG_M2: f64 = 8e3;
const PITCH_KG_M2: f64 = 60e3;
const YAW_KG_M2: f64 = 70e3;
/// Total stiffness of the springs under a body, N/m; each is at +-3 m and +-1 m from the centre.
const SPRINGS: f64 = 1e6;

/// Two equal bodies on springs at the height of their centres, connected by an element at the point `at`.
fn pair(at: [f64; 3], law: Law) -> VehicleParameters {
    let body = |name: &str| {
        let inertia_kg_m2 = [ROLL_KG_M2, PITCH_KG_M2, YAW_KG_M2];
        Body::new(name, MASS_KG, inertia_kg_m2, 1.5)
    };
    let springs = |name: &str, x: f64| four_springs(name, [0.25 * SPRINGS; 3], x, [3.0, 1.0, 1.5]);
    let ends = [End::body("front", at), End::body("rear", at)];
    VehicleParameters::new("pair")
        .with_bodies([body("front").with_x_m(5.0), body("rear").with_x_m(-5.0)])
        .with_wheelsets([free_wheelset()])
        .with_elements(springs("front", 5.0))
        .with_elements(springs("rear", -5.0))
        .with_elements([Element::new("link", ends, law)])
}

/// Equations of motion of both bodies in lateral displacement and roll, with a moment `link(roll, roll rate)` between
/// them.
///
/// The load of the springs couples lateral and roll by half the weight: see the pendulum in `closed_forms`.
fn lateral_and_roll(link: impl Fn(f64, f64) -> f64) -> impl Fn(&[f64; 8]) -> [f64; 8] {
    let coupling = 0.5 * MASS_KG * GRAVITY_M_PER_S2;
    move |[y1, r1, y2, r2, vy1, vr1, vy2, vr2]| {
        let moment = link(r2 - r1, vr2 - vr1);
        let lateral = |y: f64, r: f64| (coupling * r - SPRINGS * y) / MASS_KG;
        let roll = |y: f64, r: f64, m: f64| (coupling * y - SPRINGS * r + m) / ROLL_KG_M2;
        [
            *vy1,
            *vr1,
            *vy2,
            *vr2,
            lateral(*y1, *r1),
            roll(*y1, *r1, moment),
            lateral(*y2, *r2),
            roll(*y2, *r2, -moment),
        ]
    }
}

/// Compares one coordinate of both bodies with the expected motion.
fn compare(
    found: &[Vec<[f64; 5]>],
    coordinate: usize,
    expected: impl Iterator<Item = [f64; 2]>,
    amplitude: f64,
) {
    let mut ticks = 0;
    for (bodies, expected) in found.iter().zip(expected) {
        for (body, expected) in expected.into_iter().enumerate() {
            let found = bodies[body][coordinate];
            assert!(
                (found - expected).abs() < 2e-3 * amplitude,
                "tick {ticks}, body {body}: {found} for {expected}"
            );
        }
        ticks += 1;
    }
    assert_eq!(ticks, found.len());
}

#[test]
fn an_anti_roll_bar_resists_the_roll_of_one_body_relative_to_the_other() {
    let law = Law::AntiRollBar {
        stiffness_n_m_per_rad: 2e6,
    };
    let start = [0.0, 0.0, 5e-3, 0.0, 0.0];
    let found = free_motion(&pair([0.0, 0.0, 1.5], law), &[start], 0.25e-3, 1.5);
    let rate = lateral_and_roll(|roll, _| 2e6 * roll);
    let start = [0.0, 5e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let expected = runge_kutta(start, rate, 0.25e-3, 4, found.len());
    compare(&found, 2, expected.iter().map(|y| [y[1], y[3]]), 5e-3);
    compare(&found, 0, expected.iter().map(|y| [y[0], y[2]]), 5e-3);
}

#[test]
fn a_bush_resists_and_damps_each_rotation_of_one_body_relative_to_the_other() {
    let law = Law::Bush {
        stiffness_n_per_m: [0.0; 3],
        damping_n_s_per_m: [0.0; 3],
        stiffness_n_m_per_rad: [2e6, 30e6, 40e6],
        damping_n_m_s_per_rad: [20e3, 200e3, 300e3],
    };
    let start = [0.0, 0.0, 5e-3, 2e-3, -3e-3];
    let found = free_motion(&pair([0.0, 0.0, 1.5], law), &[start], 0.25e-3, 1.5);
    let rate = lateral_and_roll(|roll, roll_rate| 2e6 * roll + 20e3 * roll_rate);
    let rolling = [0.0, 5e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let expected = runge_kutta(rolling, rate, 0.25e-3, 4, found.len());
    compare(&found, 2, expected.iter().map(|y| [y[1], y[3]]), 5e-3);
    // Pitch and yaw of each body are oscillators. The springs resist both, because they are 3 m ahead of and behind the
    // centre. Their distance of 1 m to each side adds resistance to yaw.
    for (coordinate, inertia, springs, stiffness, damping, start) in [
        (3, PITCH_KG_M2, 9.0 * SPRINGS, 30e6, 200e3, 2e-3),
        (4, YAW_KG_M2, 10.0 * SPRINGS, 40e6, 300e3, -3e-3),
    ] {
        let rate = move |[a, b, va, vb]: &[f64; 4]| {
            let moment = stiffness * (b - a) + damping * (vb - va);
            let first = (moment - springs * a) / inertia;
            [*va, *vb, first, (-moment - springs * b) / inertia]
        };
        let expected = runge_kutta([start, 0.0, 0.0, 0.0], rate, 0.25e-3, 4, found.len());
        compare(
            &found,
            coordinate,
            expected.iter().map(|y| [y[0], y[1]]),
            start.abs(),
        );
    }
}

/// A vertical spring between the bodies, 1 m behind the centre of the front body and 9 m ahead of that of the rear
/// body.
#[test]
fn a_spring_between_bodies_acts_with_the_lever_arm_on_each() {
    const LINK: f64 = 0.6e6;
    let law = Law::SpringDamper {
        stiffness_n_per_m: [0.0, 0.0, LINK],
        damping_n_s_per_m: [0.0; 3],
    };
    let start = [0.0, 4e-3, 0.0, 1e-3, 0.0];
    let found = free_motion(&pair([4.0, 0.0, 1.5], law), &[start], 0.25e-3, 1.5);
    // A point x ahead of the centre sinks by z - pitch x.
    let rate = |[z1, p1, z2, p2, vz1, vp1, vz2, vp2]: &[f64; 8]| {
        let force = LINK * ((z2 - 9.0 * p2) - (z1 + p1));
        [
            *vz1,
            *vp1,
            *vz2,
            *vp2,
            (force - SPRINGS * z1) / MASS_KG,
            (force - 9.0 * SPRINGS * p1) / PITCH_KG_M2,
            (-force - SPRINGS * z2) / MASS_KG,
            (9.0 * force - 9.0 * SPRINGS * p2) / PITCH_KG_M2,
        ]
    };
    let start = [4e-3, 1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let expected = runge_kutta(start, rate, 0.25e-3, 4, found.len());
    compare(&found, 1, expected.iter().map(|y| [y[0], y[2]]), 4e-3);
    compare(&found, 3, expected.iter().map(|y| [y[1], y[3]]), 1e-3);
}
