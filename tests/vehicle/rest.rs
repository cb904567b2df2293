//! A vehicle in equilibrium stays at rest.

use dashpot_rail::track::Track;
use dashpot_rail::vehicle::Vehicle;

use crate::support::{contact, locomotive, mass_kg, run};

#[test]
fn the_locomotive_rests_for_a_minute() {
    let parameters = locomotive();
    let vehicle = Vehicle::new(&parameters, contact(0.0), 1e-3).unwrap();
    let track = Track::default();
    let mut state = vehicle.at_rest(&track, 0.0, 50.0).unwrap();
    let weight = 9.81 * mass_kg(&parameters);
    run(&vehicle, &mut state, &track, 60.0);
    assert!((state.distance_m() - 3000.0).abs() < 1e-6);
    // Only the rounding of the contact tables moves the bodies, and the rails carry the weight.
    for coordinates in state.coordinates() {
        for coordinate in coordinates {
            assert!(coordinate.abs() < 1e-8, "{coordinates:?}");
        }
    }
    let carried: f64 = state
        .contacts()
        .iter()
        .map(|contact| -contact.force_n[2])
        .sum();
    assert!((carried / weight - 1.0).abs() < 1e-6, "{carried}");
    assert!(
        state
            .damper_forces_n()
            .iter()
            .all(|force| force.abs() < 1e-3)
    );
}
