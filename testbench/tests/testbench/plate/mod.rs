//! Shim stacks as plates: compares them with closed forms, with statics and with CalculiX.

mod axisymmetric;
mod calculix;
mod correction;
mod harmonics;

use dashpot_core::parameters::{Element, Shims, Valve};
use dashpot_files::damper;
use dashpot_testbench::plate::{Stack, Stacking};

/// Radii of the paper's piston and foot discs (m).
const RADII_M: [(f64, f64); 2] = [(16e-3, 29e-3), (5e-3, 11e-3)];

/// A sliding stack of steel discs, E = 2e11 Pa and nu = 0.3.
fn stack(clamp_m: f64, free_m: f64, discs_m: &[f64]) -> Stack {
    stack_of(clamp_m, free_m, discs_m, Stacking::Sliding)
}

fn stack_of(clamp_m: f64, free_m: f64, discs_m: &[f64], stacking: Stacking) -> Stack {
    let discs = Shims::new(discs_m).unwrap();
    let valve = Valve::with_shims(clamp_m, free_m, discs, 0.61);
    Stack::new("valve", &valve, stacking).unwrap()
}

/// The three valves of the paper: piston extension, piston compression, foot.
fn paper_stacks() -> [Stack; 3] {
    let parameters = damper::load("paper", &[]).unwrap();
    let Element::Physical(hydraulics) = &parameters.element else {
        panic!("no valves")
    };
    let valves = &hydraulics.valves;
    [
        &valves.piston_extension,
        &valves.piston_compression,
        &valves.foot_compression,
    ]
    .map(|valve| Stack::new("valve", valve, Stacking::Sliding).unwrap())
}
