//! A straight line that turns by a small angle, given as lateral irregularity, left the wheelsets yawed against the
//! rails with permanent creep forces: the rate at which the irregularity shifts the rail under a wheel counted as a
//! motion of the rail's surface, which rests.

use std::fmt::Write as _;

use dashpot_rail::track::measured::{self, Options};
use dashpot_rail::track::{Layout, Part, Track};
use dashpot_rail::vehicle::{Body, Element, End, Law, Vehicle, VehicleParameters, Wheelset};

use crate::support::{contact, run};

/// Angle by which the line turns, rad.
const TURN_RAD: f64 = 1e-3;

fn wagon() -> VehicleParameters {
    let law = Law::SpringDamper {
        stiffness_n_per_m: [5e6, 5e6, 1e6],
        damping_n_s_per_m: [50e3, 50e3, 20e3],
    };
    let wheelset = |name: &str, x_m: f64| {
        Wheelset::new(name, 1.5e3, [800.0, 100.0, 800.0], 0.625).with_x_m(x_m)
    };
    let mut elements = Vec::new();
    for (name, x) in [("front", 2.0), ("rear", -2.0)] {
        for y in [1.0, -1.0] {
            let at = [x, y, 0.625];
            let ends = [End::body(name, at), End::body("body", at)];
            elements.push(Element::new(format!("{name} {y}"), ends, law.clone()));
        }
    }
    VehicleParameters::new("wagon")
        .with_bodies([Body::new("body", 15e3, [20e3, 50e3, 50e3], 1.5)])
        .with_wheelsets([wheelset("front", 2.0), wheelset("rear", -2.0)])
        .with_elements(elements)
}

/// Straight ahead, then turned by [`TURN_RAD`] between 60 and 80 m.
fn turned_line() -> Track {
    let mut text = String::from("distance_m,lateral_mm\n");
    for i in 0..1600 {
        let distance_m = 0.25 * f64::from(i);
        let lateral_m = match distance_m {
            before if before < 60.0 => 0.0,
            within if within < 80.0 => TURN_RAD * (within - 60.0).powi(2) / 40.0,
            behind => TURN_RAD * (behind - 70.0),
        };
        let _ = writeln!(text, "{distance_m},{}", 1e3 * lateral_m);
    }
    let (irregularity, _) = measured::parse(&text, &Options::default()).unwrap();
    let straight = Part::Straight { length_m: 1e3 };
    Track::new(Layout::new(&[straight]).unwrap(), irregularity, vec![]).unwrap()
}

#[test]
fn a_vehicle_follows_a_line_that_turns() {
    let (vehicle, track) = (
        Vehicle::new(&wagon(), contact(0.3), 1e-3).unwrap(),
        turned_line(),
    );
    let mut state = vehicle.at_rest(&track, 5.0, 15.0).unwrap();
    run(&vehicle, &mut state, &track, 21.0);
    for (name, coordinates) in vehicle.names().iter().zip(state.coordinates()) {
        let yaw = coordinates[4] / TURN_RAD;
        assert!((yaw - 1.0).abs() < 0.01, "{name}: {yaw} of the turn");
    }
    for (wheelset, x_m) in [(1, 2.0), (2, -2.0)] {
        let [left, right] = track.rails(state.distance_m() + x_m);
        let middle_m = 0.5 * (left.lateral_m + right.lateral_m);
        let off_m = state.coordinates()[wheelset][0] - middle_m;
        assert!(
            off_m.abs() < 20e-6,
            "wheelset {wheelset} is off by {off_m} m"
        );
    }
    for contact in state.contacts() {
        assert!(contact.force_n[1].abs() < 20.0, "{:?}", contact.force_n);
    }
}
