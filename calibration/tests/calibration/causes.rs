//! The bank of causes against recordings of the reference solver, which shares no law with the bank's models.

use std::f64::consts::TAU;

use dashpot_calibration::Recorded;
use dashpot_calibration::cause::{CauseKind, Causes, MAX_UNEXPLAINED};
use dashpot_core::CheckedParameters;
use dashpot_files::damper::{KeyedParameters, load};
use dashpot_testbench::health::Noise;
use dashpot_testbench::verification::reference_forces;
use fastrand::Rng;

/// Sample interval (s).
const INTERVAL_S: f64 = 1e-3;

/// Duration of a recording (s).
const DURATION_S: f64 = 12.0;

/// Noise as a share of the rms of each signal.
const NOISE: f64 = 0.02;

const SEEDS: u64 = 3;

/// Physical dampers and a reduced one.
const DAMPERS: [&str; 3] = ["in-service", "paper", "reduced-lateral"];

#[derive(Clone, Copy, Debug)]
enum Fault {
    None,
    Flow(f64),
    Stiffness(f64),
    ClearanceM(f64),
    ForceScale(f64),
    DisplacementScale(f64),
    ForceZeroN(f64),
    Late(usize),
    Reversed,
    Dropouts,
    DisplacementHeld,
}

const FAULTS: [(Fault, CauseKind); 15] = [
    (Fault::None, CauseKind::AsNew),
    (Fault::Flow(1.25), CauseKind::Flow),
    (Fault::Flow(0.75), CauseKind::Flow),
    (Fault::Stiffness(0.5), CauseKind::Stiffness),
    (Fault::Stiffness(2.0), CauseKind::Stiffness),
    (Fault::ClearanceM(1e-3), CauseKind::Clearance),
    (Fault::ForceScale(1.2), CauseKind::ForceScale),
    (Fault::ForceScale(0.8), CauseKind::ForceScale),
    (Fault::DisplacementScale(1.2), CauseKind::DisplacementScale),
    (Fault::ForceZeroN(1000.0), CauseKind::ForceZero),
    (Fault::Late(6), CauseKind::Lag),
    (Fault::Late(12), CauseKind::Lag),
    (Fault::Reversed, CauseKind::Reversed),
    (Fault::Dropouts, CauseKind::ForceHeld),
    (Fault::DisplacementHeld, CauseKind::DisplacementHeld),
];

/// Two faults at once.
const PAIRS: [[Fault; 2]; 3] = [
    [Fault::Flow(1.35), Fault::ClearanceM(3e-3)],
    [Fault::Stiffness(0.3), Fault::ForceScale(1.4)],
    [Fault::ClearanceM(3e-3), Fault::Late(12)],
];

/// Returns a ride of 0.4 to 20 Hz with an rms velocity of 0.04 m/s.
fn ride(rng: &mut Rng) -> Vec<f64> {
    const LINES: usize = 60;
    let lines: Vec<(f64, f64, f64)> = (0..LINES)
        .map(|_| {
            let w = TAU * 0.4 * 50_f64.powf(rng.f64());
            let velocity = 0.04 * (2.0 / LINES as f64).sqrt();
            (velocity / w, w, TAU * rng.f64())
        })
        .collect();
    let samples = (DURATION_S / INTERVAL_S) as usize;
    let at = |sample: usize| {
        let time_s = sample as f64 * INTERVAL_S;
        lines
            .iter()
            .map(|(a, w, phase)| a * (w * time_s + phase).sin())
            .sum()
    };
    (0..samples).map(at).collect()
}

/// Returns the changed parameters of a damper with a fault of its own.
fn changes(keyed: &KeyedParameters, fault: Fault) -> Vec<(String, f64)> {
    let scaled = |part: &str, factor: f64| -> Vec<(String, f64)> {
        let keys = keyed.keys().into_iter().filter(|key| key.ends_with(part));
        keys.map(|key| (key.clone(), factor * keyed.number(&key).unwrap()))
            .collect()
    };
    match fault {
        Fault::Flow(factor) => [
            scaled(".discharge_coefficient", factor),
            scaled("reduced.damping_n_s_per_m", 1.0 / factor),
            scaled("reduced.saturation_velocity_m_per_s", factor),
        ]
        .concat(),
        Fault::Stiffness(factor) => scaled("mount.stiffness_n_per_m", factor),
        Fault::ClearanceM(more_m) => {
            let clearance = keyed.number("mount.clearance_m").unwrap();
            vec![("mount.clearance_m".to_owned(), clearance + more_m)]
        }
        _ => Vec::new(),
    }
}

fn worn(keyed: &KeyedParameters, faults: &[Fault]) -> CheckedParameters {
    let changes: Vec<_> = faults
        .iter()
        .flat_map(|fault| changes(keyed, *fault))
        .collect();
    let changes: Vec<(&str, f64)> = changes
        .iter()
        .map(|(key, value)| (key.as_str(), *value))
        .collect();
    keyed.with(&changes).unwrap()
}

fn recorded(keyed: &KeyedParameters, faults: &[Fault], seed: u64) -> Recorded {
    let mut rng = Rng::with_seed(seed);
    let x = ride(&mut rng);
    let forces = reference_forces(&worn(keyed, faults), INTERVAL_S, &x).unwrap();
    let noise = Noise::from_rms(NOISE, &x, &forces);
    let (mut x, mut forces) = noise.add_to(&x, &forces, rng.u64(..));
    let lates = faults.iter().map(|fault| match fault {
        Fault::Late(samples) => *samples,
        _ => 0,
    });
    let late = lates.sum();
    for fault in faults {
        disturb(*fault, &mut x, &mut forces);
    }
    let samples = x.len();
    Recorded {
        name: "ride".into(),
        times_s: (late..samples)
            .map(|sample| sample as f64 * INTERVAL_S)
            .collect(),
        displacements_m: x[late..].to_vec(),
        forces_n: forces[..samples - late].to_vec(),
    }
}

/// Adds a fault of a sensor.
fn disturb(fault: Fault, x: &mut [f64], forces: &mut [f64]) {
    match fault {
        Fault::ForceScale(scale) => forces.iter_mut().for_each(|force| *force *= scale),
        Fault::DisplacementScale(scale) => x.iter_mut().for_each(|x| *x *= scale),
        Fault::ForceZeroN(zero_n) => forces.iter_mut().for_each(|force| *force += zero_n),
        Fault::Reversed => forces.iter_mut().for_each(|force| *force = -*force),
        Fault::Dropouts => forces
            .chunks_mut(1000)
            .for_each(|second| second[..100].fill(0.0)),
        Fault::DisplacementHeld => x.chunks_mut(1000).for_each(|second| {
            let held = second[0];
            second[..200].fill(held);
        }),
        _ => {}
    }
}

/// Prints the table of docs/health.md: how often each cause is named, and its mean probability.
#[test]
fn the_cause_of_a_change_is_named() {
    let runs: Vec<(usize, usize, u64)> = (0..DAMPERS.len())
        .flat_map(|damper| (0..FAULTS.len()).map(move |fault| (damper, fault)))
        .flat_map(|(damper, fault)| (0..SEEDS).map(move |seed| (damper, fault, seed)))
        .collect();
    let found = dashpot_workers::map(&runs, |(damper, fault, seed)| {
        let name = DAMPERS[*damper];
        let keyed = KeyedParameters::new(name, &load(name, &[]).unwrap()).unwrap();
        let recording = recorded(&keyed, &[FAULTS[*fault].0], seed + 100);
        Ok::<_, ()>(Causes::find(&keyed, &recording, INTERVAL_S).unwrap())
    })
    .unwrap();
    let mut wrong = Vec::new();
    for (number, (fault, expected)) in FAULTS.iter().enumerate() {
        for (damper, name) in DAMPERS.iter().enumerate() {
            let of_fault = runs.iter().zip(&found);
            let of_fault = of_fault.filter(|((d, f, _), _)| (*d, *f) == (damper, number));
            let mut line = String::new();
            for (_, causes) in of_fault {
                let first = causes.causes[0];
                line += &format!(
                    "  {:?} {:.4} {:.2} ({:.2})",
                    first.kind, first.value, first.probability, causes.unexplained
                );
                if first.kind != *expected {
                    wrong.push(format!(
                        "{name} {fault:?}: {:?}",
                        &causes.causes[..2.min(causes.causes.len())]
                    ));
                }
            }
            println!("{name:<16} {fault:?}:{line}");
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn two_faults_at_once_are_not_blamed_on_one() {
    for name in DAMPERS {
        let keyed = KeyedParameters::new(name, &load(name, &[]).unwrap()).unwrap();
        for faults in PAIRS {
            let recording = recorded(&keyed, &faults, 7);
            let causes = Causes::find(&keyed, &recording, INTERVAL_S).unwrap();
            let first = causes.causes[0];
            println!("{name:<16} {faults:?}: {first:?} {:.3}", causes.unexplained);
            if matches!(faults[1], Fault::Late(_)) {
                // A delay is fitted along with every cause.
                assert_eq!(first.kind, CauseKind::Clearance);
                assert!((causes.delay_s - 12e-3).abs() < 1e-3, "{}", causes.delay_s);
            } else {
                assert!(
                    causes.unexplained > MAX_UNEXPLAINED,
                    "{}",
                    causes.unexplained
                );
                assert_eq!(causes.likely(), None);
            }
        }
    }
}
