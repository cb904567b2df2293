//! The force on a dipped joint, against the closed form of British Rail.

use std::f64::consts::PI;

use dashpot_rail::track::measured::{self, Options};
use dashpot_rail::track::{Layout, Track};
use dashpot_rail::vehicle::{
    Body, Element, End, GRAVITY_M_PER_S2, Law, RailSupport, Vehicle, VehicleParameters, Wheelset,
};

use crate::support::contact;

/// Load of a wheel at standstill, N, and half the mass of a wheelset, kg.
const LOAD_N: f64 = 101.3e3;
const UNSPRUNG_KG: f64 = 1620.0;

/// Angle of the joint, rad, and its place, m.
const ANGLE_RAD: f64 = 0.02;
const JOINT_M: f64 = 20.0;

/// A body on two wheelsets with springs so soft that only its weight acts on them.
fn wagon() -> VehicleParameters {
    let law = || Law::SpringDamper {
        stiffness_n_per_m: [1e6, 1e6, 0.1e6],
        damping_n_s_per_m: [0.0; 3],
    };
    let mut elements = Vec::new();
    for (wheelset, x_m) in [("front", 10.0), ("rear", -10.0)] {
        for y_m in [1.0, -1.0] {
            let at = [x_m, y_m, 0.625];
            let ends = [End::body(wheelset, at), End::body("body", at)];
            elements.push(Element::new(format!("{wheelset} {y_m}"), ends, law()));
        }
    }
    let body_kg = 4.0 * (LOAD_N / GRAVITY_M_PER_S2 - UNSPRUNG_KG);
    let wheelset = |name: &str, x_m| {
        Wheelset::new(name, 2.0 * UNSPRUNG_KG, [1500.0, 200.0, 1500.0], 0.625).with_x_m(x_m)
    };
    VehicleParameters::new("wagon")
        .with_bodies([Body::new("body", body_kg, [60e3, 1e6, 1e6], 1.0)])
        .with_wheelsets([wheelset("front", 10.0), wheelset("rear", -10.0)])
        .with_elements(elements)
}

/// Level track that rises from the joint on.
fn track() -> Track {
    let mut text = String::from("distance_m,vertical_m\n");
    for i in 0..1600 {
        let distance_m = 0.025 * f64::from(i);
        let rise_m = ANGLE_RAD * (distance_m - JOINT_M).max(0.0);
        text += &format!("{distance_m},{}\n", -rise_m);
    }
    let (irregularity, _) = measured::parse(&text, &Options::default()).unwrap();
    Track::new(Layout::default(), irregularity, vec![]).unwrap()
}

/// Greatest force in the springs of the rails under the front wheelset while it passes the joint, N.
fn force_n(speed_m_per_s: f64) -> f64 {
    let (support, track) = (RailSupport::BALLASTED, track());
    let vehicle = Vehicle::on_rails(&wagon(), contact(0.3), 1e-3, Some(support)).unwrap();
    let start_m = JOINT_M - 10.0 - 0.2;
    let mut state = vehicle.at_rest(&track, start_m, speed_m_per_s).unwrap();
    let mut greatest_n = 0.0_f64;
    for _ in 0..30 {
        vehicle.step(&mut state, &track);
        let rail_m = state.rail_coordinates()[0][1];
        greatest_n = greatest_n.max(LOAD_N + support.vertical_stiffness_n_per_m * rail_m);
    }
    assert_eq!(state.stop(), None);
    greatest_n
}

/// `P2` of Jenkins, Stephenson, Clayton, Morland and Lyon, The effect of track and vehicle parameters on wheel/rail
/// vertical dynamic forces, Railway Engineering Journal 3 (1974) 2-16: the wheel takes the mass of the rail along, and
/// both move on the spring and the dashpot of the track.
fn closed_form_n(speed_m_per_s: f64) -> f64 {
    let RailSupport {
        vertical_mass_kg: rail_kg,
        vertical_stiffness_n_per_m: stiffness,
        vertical_damping_n_s_per_m: damping,
        ..
    } = RailSupport::BALLASTED;
    let both_kg = UNSPRUNG_KG + rail_kg;
    let damped = 1.0 - PI * damping / (4.0 * (stiffness * both_kg).sqrt());
    let shared = (UNSPRUNG_KG / both_kg).sqrt();
    LOAD_N + ANGLE_RAD * speed_m_per_s * shared * damped * (stiffness * UNSPRUNG_KG).sqrt()
}

#[test]
fn a_dipped_joint_loads_the_track_with_the_published_force() {
    for speed_km_h in [100.0, 160.0, 180.0] {
        let speed_m_per_s = speed_km_h / 3.6;
        let expected_n = closed_form_n(speed_m_per_s);
        let found_n = force_n(speed_m_per_s);
        assert!(
            (found_n / expected_n - 1.0).abs() < 0.03,
            "{speed_km_h} km/h: {found_n} for {expected_n}"
        );
    }
}
