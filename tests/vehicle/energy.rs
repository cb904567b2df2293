//! Energy balance on ideal track: the locomotive loses the energy that dampers, dashpots and creep dissipate.

use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Vehicle, VehicleState};

use crate::support::{contact, locomotive};

const STEP_S: f64 = 0.25e-3;

/// Power dissipated by creep, and driving power that keeps the speed constant (W).
fn powers(state: &VehicleState) -> [f64; 2] {
    let contacts = state.contacts();
    let wheels = contacts.iter().flat_map(|contact| &contact.wheels);
    let creep = wheels.flat_map(|wheel| wheel.loaded_patches());
    let drive = contacts.iter().map(|contact| -contact.force_n[0]);
    [
        creep.map(|patch| patch.dissipation_w).sum(),
        drive.sum::<f64>() * state.speed_m_per_s(),
    ]
}

#[test]
fn lost_energy_equals_dissipated_energy() {
    let vehicle = Vehicle::new(&locomotive(), contact(0.0), STEP_S).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 30.0).unwrap();
    // All coordinates of the body and most of a bogie are displaced, so everything moves.
    vehicle
        .displace(&mut state, &track, 0, [8e-3, -12e-3, 4e-3, 2e-3, 1e-3])
        .unwrap();
    vehicle
        .displace(&mut state, &track, 1, [1e-3, -2e-3, 0.0, 0.5e-3, 1e-3])
        .unwrap();
    let start = vehicle.energy(&state).unwrap();
    let (mut dissipated, mut driven, mut into_dampers) = (0.0, 0.0, 0.0);
    // The trapezoidal rule integrates the powers.
    let mut before = (powers(&state), start.dissipation_w, state.clone());
    for _ in 0..12_000 {
        vehicle.step(&mut state, &track);
        let now = (
            powers(&state),
            vehicle.energy(&state).unwrap().dissipation_w,
            state.clone(),
        );
        let ([creep, drive], dashpots, _) = now;
        let ([last_creep, last_drive], last_dashpots, last) = &before;
        dissipated += 0.5 * STEP_S * (creep + last_creep + dashpots + last_dashpots);
        driven += 0.5 * STEP_S * (drive + last_drive);
        let forces = state.damper_forces_n().iter().zip(last.damper_forces_n());
        let places = state
            .damper_displacements_m()
            .iter()
            .zip(last.damper_displacements_m());
        for ((force, last_force), (place, last_place)) in forces.zip(places) {
            into_dampers += 0.5 * (force + last_force) * (place - last_place);
        }
        before = now;
    }
    let lost = start.total_j() - vehicle.energy(&state).unwrap().total_j();
    assert!(
        start.total_j() > 500.0 && lost > 0.99 * start.total_j(),
        "{lost} of {start:?}"
    );
    assert!(into_dampers > 0.5 * lost && dissipated > driven + 0.1 * lost);
    let balance = lost + driven - dissipated - into_dampers;
    assert!(
        balance.abs() < 1e-3 * start.total_j(),
        "{balance} J of {} J",
        start.total_j()
    );
}
