//! Instructions per step on this machine, counted by Valgrind: `cargo xtask bench --instructions`.
//! Each figure is of 1000 steps.
#![allow(missing_docs)] // gungraun's macros

use std::hint::black_box;

use dashpot::damper;
use dashpot::newton::NewtonDamper;
use dashpot_core::{Damper, step_bank};
use dashpot_hil::study::excitation::Excitation;
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

#[library_benchmark]
#[bench::paper(built("paper"))]
fn bank_of_16((damper, motion): (Damper<f32>, Vec<f32>)) -> f32 {
    let mut states = [damper.at_rest(0.0); 16];
    let mut forces = [0.0; 16];
    for &x in &motion {
        step_bank(
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

library_benchmark_group!(
    name = steps,
    benchmarks = [single, bank_of_16, plain_newton]
);
main!(library_benchmark_groups = steps);
