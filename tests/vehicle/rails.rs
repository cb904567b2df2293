//! Tests of elastically supported rails.

use dashpot_rail::contact::Status;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Law, RailSupport, Vehicle};

use crate::support::{contact, curve, locomotive, run};

const SUPPORT: RailSupport = RailSupport::new(60.0)
    .with_lateral(40e6, 60e3)
    .with_vertical(80e6, 60e3);

/// In a curve, the displacement of each rail is the change of its force divided by its stiffness.
#[test]
fn rails_move_by_force_over_stiffness() {
    let parameters = locomotive();
    let vehicle = Vehicle::on_rails(&parameters, contact(0.3), 1e-3, Some(SUPPORT)).unwrap();
    let straight = vehicle.at_rest(&Track::default(), 0.0, 20.0).unwrap();
    let standing: Vec<[[f64; 3]; 2]> = straight
        .contacts()
        .iter()
        .map(|contact| [contact.wheels[0].force_n, contact.wheels[1].force_n])
        .collect();
    let track = curve(300.0);
    let mut state = vehicle.at_rest(&track, 0.0, 70.0 / 3.6).unwrap();
    run(&vehicle, &mut state, &track, 15.0);
    assert_eq!(state.status(), Status::Rolling);
    assert_eq!(
        (state.coordinates().len(), state.rail_coordinates().len()),
        (9, 6)
    );
    let rails = state.rail_coordinates();
    for ((contact, rails), standing) in state.contacts().iter().zip(rails).zip(&standing) {
        for side in 0..2 {
            let [_, y, z] = contact.wheels[side].force_n;
            let [_, y0, z0] = standing[side];
            let lateral = (y0 - y) / SUPPORT.lateral_stiffness_n_per_m;
            let vertical = (z0 - z) / SUPPORT.vertical_stiffness_n_per_m;
            assert!(
                (rails[2 * side] - lateral).abs() < 5e-6,
                "{rails:?} {lateral}"
            );
            assert!(
                (rails[2 * side + 1] - vertical).abs() < 5e-6,
                "{rails:?} {vertical}"
            );
        }
    }
    // The outer rail of the leading wheelset is pushed outward by about 70 kN.
    assert!((-2.5e-3..-1e-3).contains(&rails[0][0]), "{:?}", rails[0]);
}

/// Very stiff supports give the results of rigid rails.
#[test]
fn very_stiff_rails_behave_as_rigid_rails() {
    let (parameters, track) = (locomotive(), curve(600.0));
    let lateral = |support: Option<RailSupport>| {
        let vehicle = Vehicle::on_rails(&parameters, contact(0.3), 1e-3, support).unwrap();
        let mut state = vehicle.at_rest(&track, 0.0, 100.0 / 3.6).unwrap();
        run(&vehicle, &mut state, &track, 6.0);
        let contact = &state.contacts()[0];
        (state.coordinates()[3][0], contact.force_n[1])
    };
    let by = |factor: f64| {
        let mut support = SUPPORT;
        support.lateral_stiffness_n_per_m *= factor;
        support.vertical_stiffness_n_per_m *= factor;
        lateral(Some(support))
    };
    let (rigid, stiff, soft) = (lateral(None), by(1e4), by(1.0));
    assert!((stiff.0 - rigid.0).abs() < 5e-6, "{stiff:?} {rigid:?}");
    assert!((stiff.1 - rigid.1).abs() < 200.0, "{stiff:?} {rigid:?}");
    assert!((soft.0 - rigid.0).abs() > 0.3e-3, "{soft:?} {rigid:?}");
}

/// A wheelset bounces on its rails; the primary springs and the body above have little effect.
#[test]
fn a_wheelset_bounces_on_its_rails_as_two_masses_do() {
    let mut parameters = locomotive();
    for element in &mut parameters.elements {
        if let Law::SpringDamper {
            damping_n_s_per_m, ..
        } = &mut element.law
        {
            *damping_n_s_per_m = [0.0; 3];
        }
    }
    let mut support = SUPPORT;
    support.vertical_damping_n_s_per_m = 0.0;
    let step_s = 0.1e-3;
    let vehicle = Vehicle::on_rails(&parameters, contact(0.0), step_s, Some(support)).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 20.0).unwrap();
    vehicle
        .displace(&mut state, &track, 3, [0.0, 20e-6, 0.0, 0.0, 0.0])
        .unwrap();
    let bounce: Vec<f64> = (0..3000)
        .map(|_| {
            vehicle.step(&mut state, &track);
            state.coordinates()[3][1]
        })
        .collect();
    // Wheelset and rails also swing against each other, at 800 Hz; the mean over two of these periods hides it.
    let bounce: Vec<f64> = bounce
        .windows(25)
        .map(|window| window.iter().sum::<f64>() / window.len() as f64)
        .collect();
    // The crossings of the mean are half a period apart.
    let mean = bounce.iter().sum::<f64>() / bounce.len() as f64;
    let crossings: Vec<usize> = (1..bounce.len())
        .filter(|i| (bounce[i - 1] < mean) != (bounce[*i] < mean))
        .collect();
    let periods = (crossings.len() - 1) as f64 / 2.0;
    let found = periods / (step_s * (crossings.last().unwrap() - crossings[0]) as f64);
    // The wheelset stands on the contacts. The contacts stand on the masses of the rails, and these on their springs.
    // The primary springs above have 2.15 MN/m per side.
    let patches = || {
        state.contacts()[3]
            .wheels
            .iter()
            .flat_map(|wheel| wheel.loaded_patches())
    };
    let of_contact: f64 = patches().map(|patch| patch.stiffness_n_per_m).sum();
    let (m, mr) = (3239.0, 2.0 * SUPPORT.vertical_mass_kg);
    let kr = 2.0 * SUPPORT.vertical_stiffness_n_per_m;
    let above = 2.0 * 2.15e6;
    let (a, b) = ((of_contact + above) / m, (of_contact + kr) / mr);
    let mean = 0.5 * (a + b);
    let root = (0.25 * (a - b) * (a - b) + of_contact * of_contact / (m * mr)).sqrt();
    let expected = (mean - root).sqrt() / (2.0 * std::f64::consts::PI);
    assert!(
        (found / expected - 1.0).abs() < 0.02,
        "{found} Hz for {expected} Hz"
    );
}

#[test]
fn an_invalid_support_is_rejected() {
    let mut support = SUPPORT;
    support.vertical_mass_kg = -1.0;
    let error = Vehicle::on_rails(&locomotive(), contact(0.3), 1e-3, Some(support)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "rails: vertical_mass_kg = -1, allowed: 1 to 100000"
    );
}

#[test]
fn a_tick_of_1_ms_has_four_steps_on_rigid_rails_and_five_on_the_default_ones() {
    for (support, steps) in [(None, 4.0), (Some(RailSupport::BALLASTED), 5.0)] {
        let vehicle = Vehicle::on_rails(&locomotive(), contact(0.3), 1e-3, support).unwrap();
        assert_eq!((1e-3 / vehicle.inner_step_s()).round(), steps);
    }
}
