//! Dampers under a running locomotive: a fault of one is its alarm, and the others have none.

use dashpot_core::health::HealthStatus;
use dashpot_files::case::{CaseOptions, FaultOptions};
use dashpot_testbench::health::Noise;
use dashpot_vehicle_run::Run;
use dashpot_vehicle_run::signals::{all, slug};

use crate::made::{estimate, model};

const WATCHED: [&str; 2] = ["front vertical damper 1", "front vertical damper 2"];

/// Displacements (m) and forces (N) of a damper at every millisecond.
type Signals = (Vec<f64>, Vec<f64>);

/// Those of the watched dampers, and what these are.
fn signals(fault: Option<&str>) -> (Vec<Signals>, dashpot_core::DamperParameters) {
    let mut options = CaseOptions::load("straight-180").unwrap();
    options.duration_s = 25.0;
    options.faults.extend(fault.map(|change| FaultOptions {
        time_s: 10.0,
        damper: WATCHED[0].into(),
        by: None,
        overrides: vec![change.into()],
    }));
    let case = options.case().unwrap();
    assert!((case.step_s - 1e-3).abs() < 1e-12);
    let mut run = Run::new(&case).unwrap();
    let every = all(run.vehicle());
    let find = |name: String| {
        let found = every.iter().find(|signal| signal.name() == name);
        found.unwrap_or_else(|| panic!("no signal {name}"))
    };
    let watched = WATCHED.map(|name| {
        [
            find(format!("{}_displacement_m", slug(name))),
            find(format!("{}_force_n", slug(name))),
        ]
    });
    let mut samples = vec![(Vec::new(), Vec::new()); WATCHED.len()];
    while run.step().unwrap().is_none() {
        let time_s = run.time_s();
        for ([x, force], (displacements, forces)) in watched.iter().zip(&mut samples) {
            displacements.push(x.value(run.state(), time_s));
            forces.push(force.value(run.state(), time_s));
        }
    }
    (samples, case.damper(WATCHED[0]).unwrap().clone())
}

#[test]
fn a_faulty_damper_of_a_locomotive_is_told_from_its_neighbour() {
    let alarms = HealthStatus::FLOW | HealthStatus::STIFFNESS | HealthStatus::CLEARANCE;
    for (fault, expected) in [
        (None, HealthStatus::empty()),
        (Some("mount.clearance_m=2e-3"), HealthStatus::CLEARANCE),
    ] {
        let (samples, nominal) = signals(fault);
        for (place, (x, force)) in samples.iter().enumerate() {
            let noise = Noise::of_rms(0.02, x, force);
            let (x, force) = noise.on(x, force, place as u64);
            let reading = estimate(&model(&nominal, &noise), &x, &force);
            println!(
                "{fault:?}, {}: noise {noise:?}, {reading:?}",
                WATCHED[place]
            );
            let expected = if place == 0 {
                expected
            } else {
                HealthStatus::empty()
            };
            assert_eq!(
                reading.status & alarms,
                expected,
                "{fault:?}, {}",
                WATCHED[place]
            );
        }
    }
}
