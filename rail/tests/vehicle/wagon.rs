//! A wagon on two wheelsets: energy, supported rails, and forces on each wheelset.

use dashpot_core::DamperParameters;
use dashpot_core::parameters::Mount;
use dashpot_rail::creep::KalkerBook;
use dashpot_rail::track::{Defect, Irregularity, Layout, Part, Rails, Track};
use dashpot_rail::vehicle::{
    Body, Direction, Element, End, GRAVITY_M_PER_S2, Law, RailSupport, Vehicle, VehicleParameters,
    VehicleState, Wheelset,
};

use crate::support::{contact, run};

const BODY_KG: f64 = 15e3;
const WHEELSETS_KG: [f64; 2] = [1.5e3, 2.5e3];
const SPIN_KG_M2: f64 = 100.0;
const SUPPORT: RailSupport = RailSupport::new(60.0)
    .with_lateral(40e6, 60e3)
    .with_vertical(80e6, 60e3);

/// A wagon whose rear wheelset is heavier, with a vertical damper at each corner.
fn wagon() -> VehicleParameters {
    let wheelset = |name: &str, mass_kg: f64, x_m: f64| {
        Wheelset::new(name, mass_kg, [800.0, SPIN_KG_M2, 800.0], 0.625).with_x_m(x_m)
    };
    let mut elements = Vec::new();
    for (name, x) in [("front", 4.0), ("rear", -4.0)] {
        for y in [1.0, -1.0] {
            let ends = || {
                let at = [x, y, 0.625];
                [End::body(name, at), End::body("body", at)]
            };
            let law = Law::SpringDamper {
                stiffness_n_per_m: [5e6, 5e6, 1e6],
                damping_n_s_per_m: [10e3, 10e3, 5e3],
            };
            elements.push(Element::new(format!("{name} spring {y}"), ends(), law));
            let law = Law::Damper {
                direction: Direction::Vertical,
                parameters: Box::new(DamperParameters::reduced(20e3, 1.0, Mount::new(4e6))),
            };
            elements.push(Element::new(format!("{name} damper {y}"), ends(), law));
        }
    }
    let [front_kg, rear_kg] = WHEELSETS_KG;
    VehicleParameters::new("wagon")
        .with_bodies([Body::new("body", BODY_KG, [20e3, 200e3, 200e3], 1.5)])
        .with_wheelsets([
            wheelset("front", front_kg, 4.0),
            wheelset("rear", rear_kg, -4.0),
        ])
        .with_elements(elements)
}

/// A circle with cant from its start on.
fn circle(radius_m: f64, cant_m: f64) -> Track {
    let part = Part::Circular {
        radius_m,
        length_m: 1e3,
        cant_m,
    };
    let layout = Layout::new(&[part]).unwrap();
    Track::new(layout, Irregularity::default(), vec![]).unwrap()
}

/// Power dissipated by creep and dashpots, less the power that keeps the speed constant, W.
fn lost_w(vehicle: &Vehicle<KalkerBook>, state: &VehicleState) -> f64 {
    let contacts = state.contacts();
    let wheels = contacts.iter().flat_map(|contact| &contact.wheels);
    let patches = wheels.flat_map(|wheel| wheel.loaded_patches());
    let creep: f64 = patches.map(|patch| patch.dissipation_w).sum();
    let drag_n: f64 = contacts.iter().map(|contact| -contact.force_n[0]).sum();
    let dashpots = vehicle.energy(state).unwrap().dissipation_w;
    creep + dashpots - drag_n * state.speed_m_per_s()
}

/// At every time, the energy is that at the start less the lost energy.
#[test]
fn energy_goes_to_creep_dashpots_and_dampers_only() {
    const STEP_S: f64 = 0.1e-3;
    for support in [None, Some(SUPPORT)] {
        let vehicle = Vehicle::on_rails(&wagon(), contact(0.0), STEP_S, support).unwrap();
        let track = Track::default();
        let mut state = vehicle.at_rest(&track, 0.0, 30.0).unwrap();
        vehicle
            .displace(&mut state, &track, 0, [2e-3, -8e-3, 1e-3, 2e-3, 0.2e-3])
            .unwrap();
        let start_j = vehicle.energy(&state).unwrap().total_j();
        assert!(start_j > 100.0, "{start_j}");
        let (mut lost_j, mut worst_j) = (0.0, 0.0_f64);
        let mut before = (lost_w(&vehicle, &state), state.clone());
        for _ in 0..8_000 {
            vehicle.step(&mut state, &track);
            // The trapezoidal rule integrates the powers.
            let now_w = lost_w(&vehicle, &state);
            lost_j += 0.5 * STEP_S * (before.0 + now_w);
            for damper in 0..4 {
                let change = |state: &VehicleState| {
                    [
                        state.damper_forces_n()[damper],
                        state.damper_displacements_m()[damper],
                    ]
                };
                let ([force, place], [last_force, last_place]) =
                    (change(&state), change(&before.1));
                lost_j += 0.5 * (force + last_force) * (place - last_place);
            }
            let energy = vehicle.energy(&state).unwrap();
            assert_eq!(
                energy.total_j(),
                energy.kinetic_j + energy.potential_j + energy.contact_j
            );
            worst_j = worst_j.max((energy.total_j() + lost_j - start_j).abs());
            before = (now_w, state.clone());
        }
        assert!(lost_j > 0.9 * start_j, "{lost_j} of {start_j}");
        assert!(
            worst_j < 2e-3 * start_j,
            "{worst_j} of {start_j}, {support:?}"
        );
    }
}

#[test]
fn each_wheelset_carries_its_own_weight() {
    let vehicle = Vehicle::new(&wagon(), contact(5.0), 1e-3).unwrap();
    assert_eq!(vehicle.wheelsets(), 2);
    for (load_n, own_kg) in vehicle.axle_loads_n().zip(WHEELSETS_KG) {
        let expected = (0.5 * BODY_KG + own_kg) * GRAVITY_M_PER_S2;
        assert!((load_n / expected - 1.0).abs() < 1e-12, "{load_n}");
    }
}

/// In a curve, the displacement of each rail is the change of its force divided by its stiffness.
#[test]
fn the_rails_under_each_wheelset_move_by_force_over_stiffness() {
    let vehicle = Vehicle::on_rails(&wagon(), contact(5.0), 1e-3, Some(SUPPORT)).unwrap();
    let standing = vehicle.at_rest(&Track::default(), 0.0, 15.0).unwrap();
    let track = circle(800.0, 0.0);
    let mut state = vehicle.at_rest(&track, 20.0, 15.0).unwrap();
    run(&vehicle, &mut state, &track, 5.0);
    let stiffness = [
        SUPPORT.lateral_stiffness_n_per_m,
        SUPPORT.vertical_stiffness_n_per_m,
    ];
    assert_eq!(state.rail_coordinates().len(), 2);
    for (wheelset, rails) in state.rail_coordinates().iter().enumerate() {
        let (now, before) = (&state.contacts()[wheelset], &standing.contacts()[wheelset]);
        for side in 0..2 {
            for (i, stiffness) in stiffness.iter().enumerate() {
                let force_n = now.wheels[side].force_n[i + 1] - before.wheels[side].force_n[i + 1];
                let (found, expected) = (rails[2 * side + i], -force_n / stiffness);
                assert!((found - expected).abs() < 2e-6, "{found} for {expected}");
            }
        }
    }
    // The outer rail is pushed down and outward.
    let [outer_y, outer_z, ..] = state.rail_coordinates()[0];
    assert!(
        outer_y < -0.1e-3 && outer_z > 0.05e-3,
        "{outer_y} {outer_z}"
    );
}

#[test]
fn a_dip_unloads_the_wheelset_above_it() {
    let dip = Defect::CosineDip {
        rails: Rails::Both,
        start_m: 103.0,
        length_m: 2.0,
        depth_m: 20e-6,
    };
    let track = Track::new(Layout::default(), Irregularity::default(), vec![dip]).unwrap();
    let vehicle = Vehicle::new(&wagon(), contact(5.0), 1e-3).unwrap();
    for (distance_m, unloaded) in [(100.0, 0), (108.0, 1)] {
        let state = vehicle.at_rest(&track, distance_m, 20.0).unwrap();
        for (wheelset, load_n) in vehicle.axle_loads_n().enumerate() {
            let share = -state.contacts()[wheelset].force_n[2] / load_n;
            if wheelset == unloaded {
                assert!(share < 0.8, "{share}");
            } else {
                assert!((share - 1.0).abs() < 1e-6, "{share}");
            }
        }
    }
}

/// A curve to the left is the mirror image of a curve to the right, with cant and on supported rails.
#[test]
fn a_curve_to_the_left_mirrors_one_to_the_right() {
    const MIRRORED: [f64; 5] = [-1.0, 1.0, -1.0, 1.0, -1.0];
    let vehicle = Vehicle::on_rails(&wagon(), contact(5.0), 1e-3, Some(SUPPORT)).unwrap();
    let of = |side: f64| {
        let track = circle(side * 800.0, side * 0.05);
        let mut state = vehicle.at_rest(&track, 20.0, 20.0).unwrap();
        run(&vehicle, &mut state, &track, 2.0);
        state
    };
    let (right, left) = (of(1.0), of(-1.0));
    assert!(right.coordinates()[1][0].abs() > 1e-3);
    for (right, left) in right.coordinates().iter().zip(left.coordinates()) {
        for (i, sign) in MIRRORED.into_iter().enumerate() {
            assert!(
                (right[i] - sign * left[i]).abs() < 1e-10,
                "{right:?} {left:?}"
            );
        }
    }
    for (right, left) in right.rail_coordinates().iter().zip(left.rail_coordinates()) {
        let mirrored = [-left[2], left[3], -left[0], left[1]];
        for (right, mirrored) in right.iter().zip(mirrored) {
            assert!((right - mirrored).abs() < 1e-10, "{right:?} {left:?}");
        }
    }
}
