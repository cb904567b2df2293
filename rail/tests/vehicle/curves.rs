//! Elements of bodies on a clothoid with cant, against the geometry of the track.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::track::{Irregularity, Layout, Part, Track};
use dashpot_rail::vehicle::{Body, Direction, Element, End, Law, Vehicle, VehicleParameters};

use crate::support::{contact, four_springs, free_wheelset};

const MASS_KG: f64 = 20e3;
const INERTIA_KG_M2: [f64; 3] = [20e3, 200e3, 250e3];
const HEIGHT_M: f64 = 1.5;
/// Position of the second body ahead of the first, which is in the middle of the vehicle, m.
const AHEAD_M: f64 = 6.0;
const SPEED: f64 = 30.0;
/// Distance in the clothoid, m.
const AT_M: f64 = 80.0;
/// Change of curvature along the clothoid, 1/m^2.
const CURVATURE_RATE: f64 = 1.0 / 400.0 / 100.0;
/// Change of the cant's sine along the clothoid, 1/m.
const SINE_RATE: f64 = 0.15 / 1.5 / 100.0;

/// Straight track of 50 m, then a clothoid of 100 m.
fn clothoid() -> Track {
    let parts = [
        Part::Straight { length_m: 50.0 },
        Part::Transition { length_m: 100.0 },
        Part::Circular {
            radius_m: 400.0,
            length_m: 100.0,
            cant_m: 0.15,
        },
    ];
    let layout = Layout::new(&parts).unwrap();
    Track::new(layout, Irregularity::default(), vec![]).unwrap()
}

fn circle() -> Track {
    let part = Part::Circular {
        radius_m: 400.0,
        length_m: 1e3,
        cant_m: 0.15,
    };
    let layout = Layout::new(&[part]).unwrap();
    Track::new(layout, Irregularity::default(), vec![]).unwrap()
}

/// Angle of the cant at a distance in the clothoid.
fn roll(distance_m: f64) -> f64 {
    (SINE_RATE * (distance_m - 50.0)).asin()
}

/// Lateral offset and yaw of the frame under the second body from the tangent in the middle, at the height of the
/// bodies.
fn relative_frame(distance_m: f64) -> [f64; 2] {
    let (x, c) = (AHEAD_M, CURVATURE_RATE);
    let k = c * (distance_m - 50.0);
    let roll = roll(distance_m + x) - roll(distance_m);
    let offset = k * x * x / 2.0 + c * x * x * x / 6.0;
    [offset + HEIGHT_M * roll, k * x + c * x * x / 2.0]
}

/// Two bodies on springs, with other elements.
fn pair(elements: Vec<Element>) -> VehicleParameters {
    let body = |name: &str| Body::new(name, MASS_KG, INERTIA_KG_M2, HEIGHT_M);
    let springs = |name: &str, x: f64| four_springs(name, [250e3; 3], x, [3.0, 1.0, HEIGHT_M]);
    VehicleParameters::new("pair")
        .with_bodies([body("middle"), body("ahead").with_x_m(AHEAD_M)])
        .with_wheelsets([free_wheelset()])
        .with_elements(springs("middle", 0.0))
        .with_elements(springs("ahead", AHEAD_M))
        .with_elements(elements)
}

fn lateral_damper(name: &str, first: End, second: End) -> Element {
    let law = Law::Damper {
        direction: Direction::Lateral,
        parameters: Box::new(DamperParameters::reduced(2e3, 1.0, Mount::new(4e6))),
    };
    Element::new(name, [first, second], law)
}

/// Bodies move by many millimetres while the track turns under them.
#[test]
fn a_damper_has_the_displacement_of_its_ends_at_the_end_of_the_tick() {
    let at = [3.0, 0.0, HEIGHT_M];
    let parameters = pair(vec![
        lateral_damper("to the track", End::track(at), End::body("middle", at)),
        lateral_damper("ahead to the track", End::track(at), End::body("ahead", at)),
        lateral_damper("between", End::body("middle", at), End::body("ahead", at)),
    ]);
    let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
    let track = clothoid();
    let mut state = vehicle.at_rest(&track, AT_M, SPEED).unwrap();
    for (body, displacement) in [
        (0, [50e-3, 20e-3, 0.0, 0.0, 10e-3]),
        (1, [-50e-3, 0.0, 0.0, 0.0, 20e-3]),
    ] {
        vehicle
            .displace(&mut state, &track, body, displacement)
            .unwrap();
    }
    for _ in 0..400 {
        vehicle.step(&mut state, &track);
        let [y, _, _, _, yaw] = state.coordinates()[0];
        let [y_ahead, _, _, _, yaw_ahead] = state.coordinates()[1];
        let [offset, turned] = relative_frame(state.distance_m());
        let (middle, ahead) = (y + 3.0 * yaw, y_ahead - 3.0 * yaw_ahead);
        // A damper between bodies also follows the frames of both.
        let between = ahead - middle + offset - 3.0 * turned;
        for (found, expected) in state
            .damper_displacements_m()
            .iter()
            .zip([middle, ahead, between])
        {
            assert!((found - expected).abs() < 1e-7, "{found} for {expected}");
        }
    }
    assert_eq!(state.stop(), None);
}

/// Bodies that move with the track's frame have the velocities of their frames relative to each other.
#[test]
fn a_clothoid_moves_the_ends_of_a_dashpot_between_bodies() {
    let (damping, yawing) = (300e3, 500e3);
    let law = Law::Bush {
        stiffness_n_per_m: [0.0; 3],
        damping_n_s_per_m: [0.0, damping, 0.0],
        stiffness_n_m_per_rad: [0.0; 3],
        damping_n_m_s_per_rad: [0.0, 0.0, yawing],
    };
    let at = [0.0, 0.0, HEIGHT_M];
    let link = Element::new(
        "link",
        [End::body("middle", at), End::body("ahead", at)],
        law,
    );
    let track = clothoid();
    let acceleration = |elements: Vec<Element>| {
        let vehicle = Vehicle::new(&pair(elements), contact(5.0), 1e-3).unwrap();
        let state = vehicle.at_rest(&track, AT_M, SPEED).unwrap();
        state.acceleration(0)
    };
    let (with, without) = (acceleration(vec![link]), acceleration(vec![]));
    // Central difference over 2 mm.
    let [before, after] = [-1e-3, 1e-3].map(|s| relative_frame(AT_M + s));
    let rate = |i: usize| (after[i] - before[i]) / 2e-3 * SPEED;
    let lateral = rate(0) - AHEAD_M * rate(1);
    for (coordinate, expected) in [
        (0, damping * lateral / MASS_KG),
        (4, yawing * rate(1) / INERTIA_KG_M2[2]),
    ] {
        let found = with[coordinate] - without[coordinate];
        assert!(expected.abs() > 1e-3, "{coordinate}: {expected}");
        assert!(
            (found / expected - 1.0).abs() < 1e-6,
            "{coordinate}: {found} {expected}"
        );
    }
}

/// The track's frame turns along the track; elements on the track turn with it.
#[test]
fn springs_or_dashpots_to_the_track_do_not_pull_at_a_body_at_rest_in_its_frame() {
    let at = [AHEAD_M, 0.0, HEIGHT_M];
    let bush = |stiffness: f64, damping: f64| {
        let law = Law::Bush {
            stiffness_n_per_m: [0.0, stiffness, 0.0],
            damping_n_s_per_m: [0.0, damping, 0.0],
            stiffness_n_m_per_rad: [stiffness; 3],
            damping_n_m_s_per_rad: [damping; 3],
        };
        Element::new("guide", [End::track(at), End::body("ahead", at)], law)
    };
    let carried = |name: &str, x: f64| {
        // The wheelset carries the body, because dashpots alone do not.
        let at = [x, 0.0, HEIGHT_M];
        let law = Law::Bush {
            stiffness_n_per_m: [0.0, 1e6, 1e6],
            damping_n_s_per_m: [0.0; 3],
            stiffness_n_m_per_rad: [1e6; 3],
            damping_n_m_s_per_rad: [0.0; 3],
        };
        Element::new(
            name,
            [End::body("wheelset", at), End::body("ahead", at)],
            law,
        )
    };
    let track = clothoid();
    let acceleration = |guide: Option<Element>| {
        let body = Body::new("ahead", MASS_KG, INERTIA_KG_M2, HEIGHT_M).with_x_m(AHEAD_M);
        let parameters = VehicleParameters::new("guided")
            .with_bodies([body])
            .with_wheelsets([free_wheelset().with_x_m(AHEAD_M)])
            .with_elements([carried("carrier", AHEAD_M)])
            .with_elements(guide);
        let vehicle = Vehicle::new(&parameters, contact(5.0), 1e-3).unwrap();
        let state = vehicle.at_rest(&track, AT_M, SPEED).unwrap();
        state.acceleration(0)
    };
    let free = acceleration(None);
    for (stiffness, damping) in [(5e6, 0.0), (0.0, 1e6), (5e6, 1e6)] {
        let guided = acceleration(Some(bush(stiffness, damping)));
        for (guided, free) in guided.iter().zip(free) {
            assert!(
                (guided - free).abs() < 1e-6,
                "{stiffness} {damping}: {guided} {free}"
            );
        }
    }
}

/// In a circle the track turns steadily under the bodies, which stay where springs to the track hold them.
#[test]
fn bodies_follow_a_circle_without_yawing_in_their_frame() {
    let vehicle = Vehicle::new(&pair(vec![]), contact(5.0), 1e-3).unwrap();
    let track = circle();
    let mut state = vehicle.at_rest(&track, AT_M, SPEED).unwrap();
    for _ in 0..500 {
        vehicle.step(&mut state, &track);
        for body in 0..2 {
            let yaw = state.coordinates()[body][4];
            assert!(yaw.abs() < 1e-9, "{body}: {yaw}");
        }
    }
    assert_eq!(state.stop(), None);
}
