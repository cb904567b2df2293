//! The lateral force of worn pairs under constant load changes gradually over the shift.
//!
//! The steepest slope of exact theory is 1.8 kN per micrometre; the tables may have twice of that. Every step of a
//! micrometre is evaluated, so no jump can be missed.

use std::sync::Arc;

use dashpot_rail::contact::{ContactGeometry, Pair, Steel, Tables, WheelsetContact};
use dashpot_rail::creep::{Friction, Polach};
use dashpot_wear::procedure::{Procedure, WornPair};

use crate::family::member;
use crate::sweep::{Change, Given, SHIFTS_M, STEP_M, contact, greatest_change};

/// Maximum change of the lateral force over a micrometre, N.
const MAX_CHANGE_N: f64 = 4e3;
/// Yaws (rad), loads (N) and friction coefficients of the sweeps.
const SWEEPS: [(f64, f64, f64); 12] = [
    (-10e-3, 100e3, 0.0),
    (-5e-3, 100e3, 0.0),
    (0.0, 100e3, 0.0),
    (-10e-3, 100e3, 0.3),
    (-5e-3, 100e3, 0.3),
    (0.0, 100e3, 0.3),
    (5e-3, 100e3, 0.3),
    (10e-3, 100e3, 0.3),
    (-10e-3, 50e3, 0.3),
    (3e-3, 50e3, 0.0),
    (-10e-3, 150e3, 0.3),
    (3e-3, 150e3, 0.0),
];

fn tables(worn: &WornPair) -> Arc<Tables> {
    let WornPair { wheel, rail, .. } = worn;
    let pair = Pair::new(wheel.clone(), rail, Procedure::default().installation).unwrap();
    Arc::new(Tables::new(
        ContactGeometry::new(pair, Steel::default()).unwrap(),
    ))
}

fn check(name: &str, given: &Given, change: &Change) {
    let Change {
        change_n,
        lateral_m,
        forces_n,
    } = change;
    assert!(
        *change_n < MAX_CHANGE_N,
        "{name}, {given:?}: {change_n} N at {lateral_m} m: {forces_n:?} N"
    );
}

/// Looks for a greater change around the worst sweep, at other yaws and loads.
fn climb(
    contact: &WheelsetContact<Polach>,
    mut given: Given,
    mut worst: Change,
) -> (Given, Change) {
    let (mut yaw_step, mut load_step) = (2e-3, 20e3);
    for _ in 0..4 {
        let mut is_better = false;
        for (yaw, load) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let next = Given {
                yaw_rad: (given.yaw_rad + yaw * yaw_step).clamp(-10e-3, 10e-3),
                load_n: (given.load_n + load * load_step).clamp(50e3, 150e3),
                ..given
            };
            let around = [-0.15e-3, 0.15e-3].map(|beside| worst.lateral_m + beside);
            let change = greatest_change(contact, &next, around, STEP_M);
            if change.change_n > worst.change_n {
                (given, worst, is_better) = (next, change, true);
            }
        }
        if !is_better {
            (yaw_step, load_step) = (0.5 * yaw_step, 0.5 * load_step);
        }
    }
    (given, worst)
}

/// Sweeps a member of the family, and climbs from the worst sweep with and without friction.
fn sweep(name: &str) {
    let tables = tables(member(name));
    for friction in [0.0, 0.3] {
        let contact = contact(&tables, friction);
        let mut worst: Option<(Given, Change)> = None;
        for (yaw_rad, load_n, _) in SWEEPS.iter().filter(|sweep| sweep.2 == friction) {
            let given = Given {
                side: 1,
                roll_rad: 0.0,
                yaw_rad: *yaw_rad,
                load_n: *load_n,
            };
            let change = greatest_change(&contact, &given, SHIFTS_M, STEP_M);
            check(name, &given, &change);
            if worst.is_none_or(|(_, worst)| change.change_n > worst.change_n) {
                worst = Some((given, change));
            }
        }
        let (given, change) = worst.unwrap();
        let (given, change) = climb(&contact, given, change);
        check(name, &given, &change);
    }
}

#[test]
fn hollow_tread() {
    sweep("hollow tread");
}

#[test]
fn thin_flange() {
    sweep("thin flange");
}

#[test]
fn tread_and_flange() {
    sweep("worn all over");
}

#[test]
fn conformal_shapes() {
    sweep("conformal");
}

#[test]
fn worn_to_each_other() {
    sweep("worn to each other");
}

#[test]
fn field_side() {
    sweep("field side worn");
}

#[test]
fn hollow_tread_on_a_rail_with_a_worn_gauge_corner() {
    sweep("hollow tread on a rail with a worn gauge corner");
}

#[test]
fn left_and_right_unequal() {
    let names = ["tread and flange worn", "thin flange on a new rail"];
    let sides = names.map(|name| tables(member(name)));
    let contact = WheelsetContact::with_sides(sides, Polach, Friction::constant(0.3)).unwrap();
    for side in [0, 1] {
        for yaw_rad in [-8e-3, 2e-3, 8e-3] {
            let given = Given {
                side,
                roll_rad: 0.0,
                yaw_rad,
                load_n: 100e3,
            };
            let change = greatest_change(&contact, &given, SHIFTS_M, STEP_M);
            check(names[side], &given, &change);
        }
    }
}
