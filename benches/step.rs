//! Time per step, compared in one run: our step, the yardstick (plain Newton), the floor (table look-up) and the
//! reference solver.
//!
//! Each sample steps a motion from start to end. An element of criterion's throughput is a step, so the time per step
//! is the inverse of the elements per second. For the reference solver an element is a simulated millisecond.
#![allow(missing_docs)] // criterion's macros

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use dashpot::damper;
use dashpot::look_up::LookUp;
use dashpot::newton::NewtonDamper;
use dashpot_core::{Damper, Real, VectorWidth, step_bank_with};
use dashpot_reference::damper::Reference;
use dashpot_testbench::excitation::Excitation;

const STEP_S: f64 = 1e-3;
const BANK: usize = 16;

/// Random ride at each tick.
fn ride<T: Real>() -> Vec<T> {
    let motion = Excitation::Ride.displacements_m(STEP_S);
    motion.into_iter().map(T::from_f64).collect()
}

fn single<T: Real>(criterion: &mut Criterion, scalar: &str) {
    let motion = ride::<T>();
    let mut group = criterion.benchmark_group("step");
    group.throughput(Throughput::Elements(motion.len() as u64));
    for preset in ["paper", "in-service", "reduced-vertical"] {
        let damper: Damper<T> = damper(preset, &[]).build(STEP_S).expect("a preset builds");
        group.bench_function(format!("{preset} {scalar}"), |bencher| {
            let mut state = damper.at_rest(T::ZERO);
            bencher.iter(|| {
                for &x in &motion {
                    black_box(damper.step(&mut state, black_box(x)));
                }
            });
        });
    }
    group.finish();
}

/// Widths of the vectors of a bank: that of every processor, then the widest of this one.
fn widths() -> Vec<VectorWidth> {
    let (baseline, widest) = (VectorWidth::baseline(), VectorWidth::detect());
    let is_wider = widest.name() != baseline.name();
    [baseline]
        .into_iter()
        .chain(is_wider.then_some(widest))
        .collect()
}

fn bank<T: Real>(criterion: &mut Criterion, scalar: &str) {
    let motion = ride::<T>();
    let damper: Damper<T> = damper("paper", &[]).build(STEP_S).expect("a preset builds");
    let mut group = criterion.benchmark_group("step");
    group.throughput(Throughput::Elements((motion.len() * BANK) as u64));
    for width in widths() {
        let name = format!("paper {scalar}, bank of {BANK}, {}", width.name());
        group.bench_function(name, |bencher| {
            let mut states = [damper.at_rest(T::ZERO); BANK];
            let mut forces = [T::ZERO; BANK];
            let dampers = black_box([&damper; BANK]);
            bencher.iter(|| {
                for &x in &motion {
                    let displacements = black_box([x; BANK]);
                    step_bank_with(width, &dampers, &mut states, &displacements, &mut forces);
                    black_box(&forces);
                }
            });
        });
    }
    group.finish();
}

/// Measures the build of constants from parameters.
fn build(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("build");
    for (name, preset, overrides) in [
        ("reduced-vertical", "reduced-vertical", &[][..]),
        ("paper", "paper", &[]),
        ("in-service", "in-service", &[]),
        (
            "in-service, two chambers",
            "in-service",
            &["two_chamber.vapour_pressure_pa=-9e4"],
        ),
    ] {
        let parameters = damper(preset, overrides);
        group.bench_function(format!("{name} f32"), |bencher| {
            bencher.iter(|| -> Damper<f32> {
                black_box(&parameters)
                    .build(STEP_S)
                    .expect("a preset builds")
            });
        });
    }
    group.finish();
}

fn rivals(criterion: &mut Criterion) {
    let motion = ride::<f32>();
    let paper = damper("paper", &[]);
    let mut group = criterion.benchmark_group("step");
    group.throughput(Throughput::Elements(motion.len() as u64));
    group.bench_function("yardstick: plain Newton f32", |bencher| {
        let mut newton = NewtonDamper::new(&paper, STEP_S).expect("a physical damper");
        bencher.iter(|| {
            for &x in &motion {
                black_box(newton.step(black_box(x)));
            }
        });
    });
    let reference = Reference::new(&paper).expect("a preset");
    group.bench_function("floor: table look-up f32", |bencher| {
        let mut table = LookUp::new(&reference, 0.3, STEP_S);
        bencher.iter(|| {
            for &x in &motion {
                black_box(table.step(black_box(x)));
            }
        });
    });
    group.finish();
}

fn reference(criterion: &mut Criterion) {
    const TICKS: usize = 200;
    let motion = &Excitation::Ride.displacements_m(STEP_S)[..=TICKS];
    let times: Vec<f64> = (0..=TICKS).map(|tick| tick as f64 * STEP_S).collect();
    let mut solver = Reference::new(&damper("paper", &[])).expect("a preset");
    let mut group = criterion.benchmark_group("reference solver");
    group.sample_size(10);
    group.throughput(Throughput::Elements(TICKS as u64));
    group.bench_function("paper, per simulated millisecond", |bencher| {
        bencher.iter(|| solver.forces(&times, motion).expect("the motion is solved"));
    });
    group.finish();
}

fn all(criterion: &mut Criterion) {
    single::<f32>(criterion, "f32");
    single::<f64>(criterion, "f64");
    bank::<f32>(criterion, "f32");
    bank::<f64>(criterion, "f64");
    build(criterion);
    rivals(criterion);
    reference(criterion);
}

criterion_group!(benches, all);
criterion_main!(benches);
