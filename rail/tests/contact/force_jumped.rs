//! Regression: at constant load, the normal forces of worn profiles jumped between poses a fraction of a nanometre
//! apart.

use std::f64::consts::TAU;
use std::sync::Arc;

use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, Steel, Tables, WheelsetContact,
};
use dashpot_rail::creep::{Friction, Polach};
use dashpot_rail::profile::measured::{self, Mirror, Options};
use dashpot_rail::profile::{Body, Profile, s1002, uic60};

use crate::common::{LEVEL, rolling};

/// S1002 with waves of 8 mm length and 60 um amplitude on the tread: more summits than zones.
fn wavy_wheel() -> Profile {
    let wave = |y: f64| {
        let ramp = |t: f64| t.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * t.clamp(0.0, 1.0));
        60e-6 * ramp((y + 0.03) / 0.01) * ramp((0.05 - y) / 0.01) * (TAU * y / 0.008).sin()
    };
    let points: Vec<[f64; 2]> = s1002::profile()
        .points()
        .iter()
        .map(|point| [point.y_m, point.z_m + wave(point.y_m)])
        .collect();
    Profile::through("wavy", &points, 0.0).unwrap()
}

fn contact(wheel: Profile, rail: &Profile) -> WheelsetContact<Polach> {
    let pair = Pair::new(wheel, rail, Installation::default()).unwrap();
    let tables = Arc::new(Tables::new(
        ContactGeometry::new(pair, Steel::default()).unwrap(),
    ));
    WheelsetContact::new(tables, Polach, Friction::constant(0.0)).unwrap()
}

/// Greatest change of the right wheel's lateral force over a micrometre, N, at a vertical force of 100 kN, without
/// friction.
///
/// The shift changes in steps of 10 um, and in steps of 0.1 um where the force changes fast.
fn greatest_change_n(contact: &WheelsetContact<Polach>, yaw_rad: f64) -> f64 {
    let lateral_n = |lateral_m: f64| {
        let at = |vertical_m: f64| {
            let motion = Motion {
                lateral_m,
                vertical_m,
                yaw_rad,
                ..rolling(20.0)
            };
            contact.forces(&motion, &LEVEL).wheels[1].force_n
        };
        let (mut low, mut high) = (-30e-3, 3e-3);
        for _ in 0..44 {
            let middle = 0.5 * (low + high);
            if -at(middle)[2] < 100e3 {
                low = middle;
            } else {
                high = middle;
            }
        }
        at(high)[1]
    };
    let mut worst = 0.0_f64;
    let mut before = lateral_n(-16e-3);
    for step in 1..=2300 {
        let shift_m = -16e-3 + 10e-6 * f64::from(step);
        let now = lateral_n(shift_m);
        if (now - before).abs() > 2e3 {
            let mut last = before;
            for part in 1..=100 {
                let next = lateral_n(shift_m - 10e-6 + 0.1e-6 * f64::from(part));
                worst = worst.max(10.0 * (next - last).abs());
                last = next;
            }
        }
        before = now;
    }
    worst
}

#[test]
fn a_wheel_with_waves_carries_its_load_without_jumps() {
    let contact = contact(wavy_wheel(), &uic60::profile());
    for yaw_rad in [-10e-3, 0.0, 5e-3] {
        let change = greatest_change_n(&contact, yaw_rad);
        assert!(change < 4e3, "{yaw_rad}: {change} N");
    }
}

#[test]
fn the_sample_files_carry_their_load_without_jumps() {
    let read = |name: &str, body: Body, mirror: Option<Mirror>| {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/");
        let text = std::fs::read_to_string(format!("{folder}{name}")).unwrap();
        let options = Options::default().with_mirror(mirror);
        measured::parse(name, &text, body, &options).unwrap().0
    };
    for (wheel, rail, mirror) in [
        ("s1002.csv", "uic60.csv", None),
        ("s1002.whl", "uic60.ban", None),
        ("s1002.prw", "uic60.prr", None),
        ("s1002.wheel", "uic60.rail", Some(Mirror::Y)),
    ] {
        let rail = read(rail, Body::Rail, mirror);
        let contact = contact(read(wheel, Body::Wheel, None), &rail);
        let change = greatest_change_n(&contact, 4e-3);
        assert!(change < 4e3, "{wheel}: {change} N");
    }
}
