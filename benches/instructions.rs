//! Instructions per step of the damper, of a wheelset's contact and of a vehicle on this machine, counted by Valgrind:
//! `cargo xtask bench --instructions`. Each figure covers 1000 steps.
#![allow(missing_docs)] // gungraun's macros

use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;

use dashpot::damper;
use dashpot::newton::NewtonDamper;
use dashpot_core::{Damper, VectorWidth, step_bank_with};
use dashpot_files::case::{Case, CaseOptions};
use dashpot_rail::contact::{
    ContactGeometry, Installation, Motion, Pair, RailDisplacement, Steel, Tables, WheelsetContact,
    WheelsetForces,
};
use dashpot_rail::creep::{CreepLaw, Friction, KalkerBook, ShenHedrickElkins};
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{Vehicle, VehicleState};
use dashpot_testbench::excitation::Excitation;
use dashpot_vehicle_run::contact::{ContactSetup, WheelOnRail};
use gungraun::prelude::*;

const STEP_S: f64 = 1e-3;
const STEPS: usize = 1000;

fn ride() -> Vec<f32> {
    let motion = Excitation::Ride.displacements_m(STEP_S);
    motion.into_iter().take(STEPS).map(|x| x as f32).collect()
}

fn built(preset: &str) -> (Damper<f32>, Vec<f32>) {
    (
        damper(preset, &[]).build(STEP_S).expect("a preset builds"),
        ride(),
    )
}

fn yardstick() -> (NewtonDamper, Vec<f32>) {
    (
        NewtonDamper::new(&damper("paper", &[]), STEP_S).expect("a physical damper"),
        ride(),
    )
}

#[library_benchmark]
#[bench::paper(built("paper"))]
#[bench::in_service(built("in-service"))]
#[bench::reduced(built("reduced-vertical"))]
fn single((damper, motion): (Damper<f32>, Vec<f32>)) -> f32 {
    let mut state = damper.at_rest(0.0);
    for &x in &motion {
        black_box(damper.step(&mut state, black_box(x)));
    }
    state.force_n()
}

type Bank = (Damper<f32>, Vec<f32>, VectorWidth);

fn bank(width: VectorWidth) -> Bank {
    let (damper, motion) = built("paper");
    (damper, motion, width)
}

#[library_benchmark]
#[bench::baseline(bank(VectorWidth::baseline()))]
#[bench::widest(bank(VectorWidth::detect()))]
fn bank_of_16((damper, motion, width): Bank) -> f32 {
    let mut states = [damper.at_rest(0.0); 16];
    let mut forces = [0.0; 16];
    for &x in &motion {
        step_bank_with(
            width,
            &[&damper; 16],
            &mut states,
            &black_box([x; 16]),
            &mut forces,
        );
        black_box(&forces);
    }
    forces[0]
}

#[library_benchmark]
#[bench::paper(yardstick())]
fn plain_newton((mut newton, motion): (NewtonDamper, Vec<f32>)) -> f32 {
    let mut force = 0.0;
    for &x in &motion {
        force = black_box(newton.step(black_box(x)));
    }
    force
}

/// Loaded patches of a wheelset.
#[derive(Clone, Copy)]
enum Loaded {
    None,
    /// One patch on each wheel.
    Two,
    /// Two patches on the outer wheel in a curve, one on the inner.
    Three,
    /// Both rails pressed inward: tread and flange of both wheels.
    Four,
}

type Wheelset<L> = (WheelsetContact<L>, Motion, [RailDisplacement; 2]);

fn wheelset<L: CreepLaw>(law: L, loaded: Loaded) -> Wheelset<L> {
    let pair = Pair::standard(Installation::default()).expect("the standard pair is valid");
    let geometry =
        ContactGeometry::new(pair, Steel::default()).expect("the default steel is valid");
    // Valgrind takes minutes to compute the tables; the first bench keeps them for the others.
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let tables = Arc::new(Tables::cached(folder, geometry).tables);
    let contact = WheelsetContact::new(tables, law, Friction::default()).expect("dry rail");
    let mut motion = Motion {
        speed_m_per_s: 27.8,
        rotation_rad_per_s: 27.8 / 0.625,
        yaw_rad: 0.008,
        ..Motion::default()
    };
    let mut rails = [RailDisplacement::default(); 2];
    let patches = match loaded {
        Loaded::None => {
            motion.vertical_m = -20e-3;
            0
        }
        Loaded::Two => {
            motion.vertical_m = 0.27e-3;
            2
        }
        Loaded::Three => {
            (motion.lateral_m, motion.vertical_m, motion.roll_rad) = (6.4e-3, -0.15e-3, -0.65e-3);
            3
        }
        Loaded::Four => {
            motion.vertical_m = -0.7e-3;
            [rails[0].lateral_m, rails[1].lateral_m] = [6.55e-3, -6.55e-3];
            4
        }
    };
    let forces = contact.forces(&motion, &rails);
    let found: usize = forces
        .wheels
        .map(|wheel| wheel.loaded_patches().count())
        .iter()
        .sum();
    assert_eq!(found, patches);
    (contact, motion, rails)
}

fn updates<L: CreepLaw>((contact, motion, rails): Wheelset<L>) -> WheelsetForces {
    let mut forces = WheelsetForces::default();
    for _ in 0..STEPS {
        contact.update(black_box(&motion), black_box(&rails), &mut forces);
        black_box(&forces);
    }
    forces
}

#[library_benchmark]
#[bench::none(wheelset(KalkerBook::new(), Loaded::None))]
#[bench::two(wheelset(KalkerBook::new(), Loaded::Two))]
#[bench::three(wheelset(KalkerBook::new(), Loaded::Three))]
#[bench::four(wheelset(KalkerBook::new(), Loaded::Four))]
fn contact_by_book(wheelset: Wheelset<KalkerBook>) -> WheelsetForces {
    updates(wheelset)
}

#[library_benchmark]
#[bench::two(wheelset(ShenHedrickElkins, Loaded::Two))]
#[bench::four(wheelset(ShenHedrickElkins, Loaded::Four))]
fn contact_by_shen_hedrick_elkins(wheelset: Wheelset<ShenHedrickElkins>) -> WheelsetForces {
    updates(wheelset)
}

#[library_benchmark]
#[bench::two(wheelset(KalkerBook::new(), Loaded::Two))]
#[bench::four(wheelset(KalkerBook::new(), Loaded::Four))]
fn contact_with_derivatives((contact, motion, rails): Wheelset<KalkerBook>) -> WheelsetForces {
    let mut forces = WheelsetForces::default();
    for _ in 0..STEPS {
        black_box(contact.update_with_derivatives(
            black_box(&motion),
            black_box(&rails),
            &mut forces,
        ));
    }
    forces
}

type Running = (Vehicle<KalkerBook>, VehicleState, Track);

/// Returns the vehicle of the case, on the case's rails, after `seconds`.
fn running(case: Case, seconds: f64) -> Running {
    let setup = ContactSetup::of_case(&case).expect("a shipped vehicle");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let tables = |pair: &WheelOnRail| {
        let geometry = pair.geometry().expect("a shipped pair");
        Arc::new(Tables::cached(folder, geometry).tables)
    };
    let tables: Vec<_> = setup.pairs().iter().map(tables).collect();
    let contacts = setup.contacts(&tables).expect("a shipped contact");
    let vehicle = Vehicle::with_contacts(&case.vehicle, contacts, STEP_S, case.rails)
        .expect("a shipped vehicle");
    let track = case.track.build().expect("a shipped track");
    let mut state = vehicle
        .at_rest(&track, case.start_m, case.speed_m_per_s)
        .expect("a shipped case");
    for _ in 0..(seconds / STEP_S) as usize {
        vehicle.step(&mut state, &track);
    }
    (vehicle, state, track)
}

fn ideal() -> Running {
    let case = CaseOptions::new("locomotive", "ideal", 180.0).case();
    running(case.expect("vehicle and track ship"), 0.1)
}

fn shipped(case: &str, seconds: f64) -> Running {
    running(Case::load(case).expect("the case ships"), seconds)
}

#[library_benchmark]
#[bench::ideal_straight(ideal())]
#[bench::straight_of_class_6(shipped("straight-180", 1.0))]
#[bench::curve_of_600_m(shipped("curve-r600", 6.0))]
#[bench::curve_of_300_m(shipped("curve-r300", 8.0))]
fn locomotive((vehicle, mut state, track): Running) -> VehicleState {
    for _ in 0..STEPS {
        vehicle.step(&mut state, black_box(&track));
    }
    assert!(!state.is_diverged());
    state
}

library_benchmark_group!(
    name = steps,
    benchmarks = [single, bank_of_16, plain_newton]
);
library_benchmark_group!(
    name = contact,
    benchmarks = [
        contact_by_book,
        contact_by_shen_hedrick_elkins,
        contact_with_derivatives
    ]
);
library_benchmark_group!(name = vehicle, benchmarks = [locomotive]);
main!(library_benchmark_groups = steps, contact, vehicle);
