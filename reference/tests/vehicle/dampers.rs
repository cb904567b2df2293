//! Compares dampers in a vehicle with the reference damper on the same motion.

use dashpot_core::DamperParameters;
use dashpot_rail::vehicle::{Direction, Element, End, Law};
use dashpot_reference::damper::Reference;
use dashpot_reference::vehicle::VehicleReference;

use crate::common::{contact, dip, straight, times, wagon};
use crate::damper_parameters as presets;

/// Largest deviation, divided by the largest force, in a run in which the damper's range changes `changes` times.
fn deviation(parameters: DamperParameters, changes: usize) -> f64 {
    let mut vehicle = wagon([0.0, 0.0, 5e3]);
    let at = [4.0, 1.2, 0.5];
    let ends = [End::body("front axle", at), End::body("body", at)];
    let law = Law::Damper {
        direction: Direction::Vertical,
        parameters: Box::new(parameters.clone()),
    };
    vehicle.elements.push(Element::new("damper", ends, law));
    let (contact, track) = (contact(0.3), straight(vec![dip(5.0)]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 20.0, 0.0).unwrap();
    let times = times(2e-5, 20_000);
    let samples = reference.run(&times, 1e-8).unwrap();
    assert_eq!(reference.statistics().events, changes);
    let displacements: Vec<f64> = samples
        .iter()
        .map(|sample| sample.damper_displacements_m[0])
        .collect();
    let forces = Reference::new(&parameters)
        .unwrap()
        .forces(&times, &displacements)
        .unwrap();
    let largest = forces
        .iter()
        .fold(0.0f64, |largest, force| largest.max(force.abs()));
    assert!(largest > 500.0, "{largest}");
    let deviations = forces
        .iter()
        .zip(&samples)
        .map(|(force, sample)| (force - sample.damper_forces_n[0]).abs());
    deviations.fold(0.0, f64::max) / largest
}

#[test]
fn a_reduced_damper_that_yields() {
    let parameters = presets::reduced(120e3, 0.03, 8e6, 0.5e-3);
    let found = deviation(parameters, 7);
    assert!(found < 1e-4, "{found}");
}

/// The force changes its sign twice.
#[test]
fn hydraulics_without_clearance() {
    let found = deviation(presets::paper(), 2);
    assert!(found < 1e-4, "{found}");
}

#[test]
fn hydraulics_in_service() {
    let mut parameters = presets::in_service(true);
    parameters.mount.clearance_m = 0.2e-3;
    let found = deviation(parameters, 6);
    assert!(found < 1e-4, "{found}");
}
