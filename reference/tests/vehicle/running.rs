//! A wagon at rest on ideal track, and two tolerances.

use dashpot_reference::vehicle::{VehicleReference, VehicleSample};

use crate::common::{contact, dip, straight, times, wagon};

#[test]
fn nothing_moves_where_nothing_disturbs() {
    let vehicle = wagon([0.0, 0.0, 20e3]);
    let (contact, track) = (contact(0.4), straight(vec![]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 30.0, 0.0).unwrap();
    for sample in reference.run(&times(0.1, 10), 1e-8).unwrap() {
        for (q, v) in sample.coordinates.iter().zip(&sample.velocities) {
            let most = q.iter().chain(v).fold(0.0f64, |most, x| most.max(x.abs()));
            assert!(most < 1e-8, "{most} at {} s", sample.time_s);
        }
    }
}

/// What a looser tolerance changes is small against the motion, and shows that both are met.
#[test]
fn two_tolerances_agree() {
    let vehicle = wagon([0.0, 0.0, 20e3]);
    let (contact, track) = (contact(0.4), straight(vec![dip(5.0)]));
    let mut reference = VehicleReference::new(&vehicle, &contact, &track, 20.0, 0.0).unwrap();
    let times = times(1e-3, 1000);
    let fine = reference.run(&times, 1e-8).unwrap();
    let fine_steps = reference.statistics().steps;
    let loose = reference.run(&times, 1e-6).unwrap();
    assert!(reference.statistics().steps < fine_steps / 2);
    let quantities: [(&str, fn(&VehicleSample) -> f64, f64); 4] = [
        (
            "body acceleration",
            |sample| sample.accelerations[0][1],
            1e-3,
        ),
        ("body roll", |sample| sample.coordinates[0][2], 1e-5),
        ("axle lateral", |sample| sample.coordinates[1][0], 1e-3),
        (
            "wheel load",
            |sample| sample.contacts[0].wheels[0].force_n[2] + 80e3,
            1e-3,
        ),
    ];
    for (name, of, allowed) in quantities {
        let square = |x: f64| x * x;
        let apart: f64 = fine
            .iter()
            .zip(&loose)
            .map(|(a, b)| square(of(a) - of(b)))
            .sum();
        let all: f64 = fine.iter().map(|sample| square(of(sample))).sum();
        let share = (apart / all).sqrt();
        assert!(share < allowed, "{name}: {share}");
    }
}
