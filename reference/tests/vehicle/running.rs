//! A wagon on ideal track, and convergence with the tolerance.

use dashpot_reference::vehicle::{VehicleReference, VehicleSample};

use crate::common::{contact, dip, straight, times, wagon};

#[test]
fn an_undisturbed_wagon_does_not_move() {
    let vehicle = wagon([0.0, 0.0, 20e3]);
    let (contact, track) = (contact(0.4), straight(vec![]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 30.0, 0.0).unwrap();
    for sample in reference.run(&times(0.1, 10), 1e-8).unwrap() {
        for (body, (q, v)) in sample
            .coordinates
            .iter()
            .zip(&sample.velocities)
            .enumerate()
        {
            for k in 0..5 {
                // The axles start with free rolling of their most loaded patches; then their rotation settles until the
                // moment about the axle is zero.
                let allowed = if body > 0 && k == 3 { 1e-5 } else { 1e-8 };
                let largest = q[k].abs().max(v[k].abs());
                assert!(
                    largest < allowed,
                    "{body} {k}: {largest} at {} s",
                    sample.time_s
                );
            }
        }
    }
}

/// Extracts a compared quantity from a sample.
type Quantity = fn(&VehicleSample) -> f64;

/// Deviations from a finer solution are small at a tolerance of 1e-8 and larger at a looser one.
#[test]
fn the_solution_converges_with_the_tolerance() {
    let vehicle = wagon([0.0, 0.0, 20e3]);
    let (contact, track) = (contact(0.4), straight(vec![dip(5.0)]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 20.0, 0.0).unwrap();
    let times = times(1e-3, 1000);
    let fine = reference.run(&times, 1e-9).unwrap();
    let usual = reference.run(&times, 1e-8).unwrap();
    let loose = reference.run(&times, 1e-6).unwrap();
    let quantities: [(&str, Quantity); 4] = [
        ("body acceleration", |sample| sample.accelerations[0][1]),
        ("body roll", |sample| sample.coordinates[0][2]),
        ("axle lateral", |sample| sample.coordinates[1][0]),
        ("wheel load", |sample| {
            sample.contacts[0].wheels[0].force_n[2]
        }),
    ];
    for (name, quantity) in quantities {
        let start = quantity(&fine[0]);
        let sum = |squares: &mut dyn Iterator<Item = f64>| squares.sum::<f64>().sqrt();
        let all = sum(&mut fine.iter().map(|sample| (quantity(sample) - start).powi(2)));
        let deviation = |other: &[VehicleSample]| {
            let pairs = fine.iter().zip(other);
            sum(&mut pairs.map(|(a, b)| (quantity(a) - quantity(b)).powi(2))) / all
        };
        let (usual, loose) = (deviation(&usual), deviation(&loose));
        assert!(usual < 1e-3, "{name}: {usual}");
        assert!(
            loose > 3.0 * usual && loose < 1e-2,
            "{name}: {usual} {loose}"
        );
    }
}
