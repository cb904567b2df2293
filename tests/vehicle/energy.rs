//! Energy: what the locomotive loses on ideal track is what dampers, springs' dashpots and creep dissipate.

use dashpot_rail::track::Track;
use dashpot_rail::vehicle::Vehicle;

use crate::support::{contact, locomotive};

#[test]
fn energy_is_kept_but_for_what_is_dissipated() {
    let vehicle = Vehicle::new(&locomotive(), contact(0.0), 0.25e-3).unwrap();
    let track = Track::default();
    let speed = 30.0;
    let mut state = vehicle.at_rest(&track, 0.0, speed).unwrap();
    // Body aside and up, a bogie turned: lateral and vertical motion of everything.
    vehicle.displace(&mut state, &track, 0, [8e-3, -12e-3, 4e-3, 2e-3, 1e-3]);
    vehicle.displace(&mut state, &track, 1, [1e-3, -2e-3, 0.0, 0.5e-3, 1e-3]);
    let start = vehicle.energy(&state);
    let mut dissipated = 0.0;
    let mut driven = 0.0;
    let mut into_dampers = 0.0;
    let mut last = None;
    for _ in 0..12_000 {
        vehicle.step(&mut state, &track);
        let energy = vehicle.energy(&state);
        let contacts = state.contacts();
        let creep: f64 = contacts
            .iter()
            .flat_map(|contact| &contact.wheels)
            .flat_map(|wheel| wheel.loaded_patches())
            .map(|patch| patch.dissipation_w)
            .sum();
        // What keeps the speed works against the longitudinal forces.
        let drive: f64 = contacts
            .iter()
            .map(|contact| -contact.force_n[0] * speed)
            .sum();
        let forces = state.damper_forces_n().to_vec();
        let displacements = state.damper_displacements_m().to_vec();
        if let Some((last_creep, last_loss, last_drive, last_forces, last_displacements)) = last {
            let h = 0.25e-3;
            dissipated += 0.5 * h * (creep + last_creep + energy.dissipation_w + last_loss);
            driven += 0.5 * h * (drive + last_drive);
            let last_forces: Vec<f64> = last_forces;
            let last_displacements: Vec<f64> = last_displacements;
            for i in 0..forces.len() {
                into_dampers +=
                    0.5 * (forces[i] + last_forces[i]) * (displacements[i] - last_displacements[i]);
            }
        }
        last = Some((creep, energy.dissipation_w, drive, forces, displacements));
    }
    let end = vehicle.energy(&state);
    let lost = start.total_j() - end.total_j();
    let balance = lost + driven - dissipated - into_dampers;
    assert!(
        lost > 0.9 * start.total_j() && start.total_j() > 100.0,
        "{lost} of {start:?}"
    );
    assert!(into_dampers > 0.5 * lost, "{into_dampers} of {lost}");
    assert!(
        balance.abs() < 1e-3 * start.total_j(),
        "{balance} J of {} J: lost {lost}, driven {driven}, dissipated {dissipated}, dampers {into_dampers}",
        start.total_j()
    );
}
