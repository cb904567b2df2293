//! Time of a millisecond tick of the six-axle locomotive, and of its parts in the same run.
//!
//! An element is a tick. `contact` is the contact of six wheelsets in each of the five steps of a tick, with two loaded
//! patches each; `dampers` is the step of the twenty dampers; the rest of a tick is springs, track, rails, factors and
//! solution.
#![allow(missing_docs)] // criterion's macros

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dashpot_core::step_bank;
use dashpot_files::case::{Case, CaseOptions};
use dashpot_rail::contact::{Motion, RailDisplacement, WheelsetForces};
use dashpot_rail::vehicle::{Law, Vehicle, VehicleParameters};
use dashpot_vehicle_run::contact::{Contact, ContactSetup};

const STEP_S: f64 = 1e-3;
/// Number of ticks in one sample; each sample starts from the same state.
const TICKS: usize = 200;
const STEPS_A_TICK: usize = 5;
const WHEELSETS: usize = 6;
const DAMPERS: usize = 20;
/// Dampers are stepped in groups of eight, so twenty take twenty-four lanes.
const LANES: usize = 24;

/// Starts from the state of the case after `seconds`.
fn ticks(criterion: &mut Criterion, name: &str, case: &Case, seconds: f64) {
    let contacts = contacts_of(case);
    let vehicle = Vehicle::with_contacts(&case.vehicle, contacts, STEP_S, case.rails)
        .expect("a shipped vehicle is valid");
    let track = case.track.build().expect("a shipped track is valid");
    let mut start = vehicle
        .at_rest(&track, case.start_m, case.speed_m_per_s)
        .expect("a shipped case is valid");
    for _ in 0..(seconds / STEP_S) as usize {
        vehicle.step(&mut start, &track);
    }
    let mut group = criterion.benchmark_group("vehicle");
    group.throughput(Throughput::Elements(TICKS as u64));
    group.bench_function(name, |bencher| {
        let mut state = start.clone();
        bencher.iter(|| {
            state.clone_from(&start);
            for _ in 0..TICKS {
                vehicle.step(&mut state, black_box(&track));
            }
            assert!(!state.is_diverged());
        });
    });
    group.finish();
}

/// Contact of each wheelset of a case.
fn contacts_of(case: &Case) -> Vec<Contact> {
    let setup = ContactSetup::of_case(case).expect("a shipped vehicle is valid");
    setup.tabulated().expect("a shipped contact is valid")
}

fn contacts(criterion: &mut Criterion, case: &Case) {
    let contact = &contacts_of(case)[0];
    let rails = [RailDisplacement::default(); 2];
    let motion = Motion {
        speed_m_per_s: 50.0,
        rotation_rad_per_s: 50.0 / 0.625,
        vertical_m: 0.27e-3,
        yaw_rad: 8e-3,
        ..Motion::default()
    };
    let found = contact.forces(&motion, &rails);
    for wheel in &found.wheels {
        assert_eq!(wheel.loaded_patches().count(), 1, "{wheel:?}");
    }
    let mut group = criterion.benchmark_group("vehicle");
    group.throughput(Throughput::Elements(1));
    group.bench_function("contact", |bencher| {
        let mut forces: [WheelsetForces; WHEELSETS] = Default::default();
        bencher.iter(|| {
            for _ in 0..STEPS_A_TICK {
                for forces in &mut forces {
                    contact.update(black_box(&motion), black_box(&rails), forces);
                }
            }
            black_box(&forces);
        });
    });
    group.finish();
}

fn dampers(criterion: &mut Criterion, vehicle: &VehicleParameters) {
    let laws = vehicle.elements.iter().map(|element| &element.law);
    let mut dampers: Vec<_> = laws
        .filter_map(|law| match law {
            Law::Damper { parameters, .. } => Some(parameters.build::<f64>(STEP_S)),
            _ => None,
        })
        .map(|built| built.expect("a shipped damper builds"))
        .collect();
    assert_eq!(dampers.len(), DAMPERS);
    dampers.resize(LANES, dampers[DAMPERS - 1]);
    let bank: [_; LANES] = std::array::from_fn(|lane| &dampers[lane]);
    let mut group = criterion.benchmark_group("vehicle");
    group.throughput(Throughput::Elements(TICKS as u64));
    group.bench_function("dampers", |bencher| {
        let at_rest = bank.map(|damper| damper.at_rest(0.0));
        bencher.iter(|| {
            let (mut states, mut forces) = (at_rest, [0.0; LANES]);
            for tick in 0..TICKS {
                let x = 0.1e-3 * (tick % 50) as f64;
                step_bank(&bank, &mut states, &black_box([x; LANES]), &mut forces);
                black_box(&forces);
            }
        });
    });
    group.finish();
}

fn vehicle(criterion: &mut Criterion) {
    let ideal = CaseOptions::new("locomotive", "ideal", 180.0).case();
    let ideal = ideal.expect("vehicle and track ship");
    let shipped = |name| Case::load(name).expect("the case ships");
    ticks(criterion, "ideal straight", &ideal, 1.0);
    ticks(
        criterion,
        "straight of class 6",
        &shipped("straight-180"),
        2.0,
    );
    ticks(criterion, "curve of 300 m", &shipped("curve-r300"), 8.0);
    contacts(criterion, &ideal);
    dampers(criterion, &ideal.vehicle);
}

criterion_group!(benches, vehicle);
criterion_main!(benches);
