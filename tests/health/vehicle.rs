//! Dampers under a running locomotive: a faulty damper raises its own alarm and no other damper's.

use dashpot_core::health::{Health, HealthStatus};
use dashpot_files::case::{CaseOptions, FaultOptions};
use dashpot_testbench::health::Noise;
use dashpot_vehicle_run::Run;
use dashpot_vehicle_run::signals::{all, slug};

use crate::synthetic::model;

const WATCHED: [&str; 2] = ["front vertical damper 1", "front vertical damper 2"];

/// Displacements (m) and forces (N) of a damper at every millisecond.
type Signals = (Vec<f64>, Vec<f64>);

/// Signals of the watched dampers, and their parameters.
fn signals(fault: Option<&str>) -> (Vec<Signals>, dashpot_core::DamperParameters) {
    let mut options = CaseOptions::load("straight-180").unwrap();
    // To the end of the irregularities: on smooth track, nothing excites the dampers.
    options.duration_s = 19.0;
    options.faults.extend(fault.map(|change| FaultOptions {
        time_s: 3.0,
        damper: WATCHED[0].into(),
        replacement: None,
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
fn a_faulty_damper_of_a_locomotive_is_distinguished_from_its_neighbour() {
    let alarms = HealthStatus::FLOW | HealthStatus::STIFFNESS | HealthStatus::CLEARANCE;
    for (fault, expected) in [
        (None, HealthStatus::empty()),
        (Some("mount.clearance_m=2e-3"), HealthStatus::CLEARANCE),
    ] {
        let (samples, nominal) = signals(fault);
        for (index, (x, force)) in samples.iter().enumerate() {
            let noise = Noise::from_rms(0.02, x, force);
            let (x, force) = noise.add_to(x, force, index as u64);
            let model = model(&nominal, &noise);
            let mut health = Health::new(&model);
            let mut raised = HealthStatus::empty();
            for (x, force) in x.iter().zip(&force) {
                health.tick(&model, *x as f32, *force as f32);
                raised |= health.reading(&model).status & alarms;
            }
            let expected = if index == 0 {
                expected
            } else {
                HealthStatus::empty()
            };
            assert_eq!(raised, expected, "{fault:?}, {}", WATCHED[index]);
        }
    }
}
