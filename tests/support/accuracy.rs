//! Compares the fixed step with the reference solver: dampers, motions and errors.

use std::collections::HashMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_core::DamperParameters;
use dashpot_reference::deviation::nrmse;
use dashpot_testbench::compiled::Compiled;
use dashpot_testbench::excitation::Excitation;
use dashpot_testbench::verification::{fixed_step_forces, reference_forces};

use crate::damper;

/// A damper of the accuracy table: its name there, the preset and its overrides.
pub const DAMPERS: [(&str, &str, &[&str]); 7] = [
    ("paper", "paper", &[]),
    (
        "paper, 2a 1 mm, Ke 8 MN/m",
        "paper",
        &["mount.clearance_m=1e-3", "mount.stiffness_n_per_m=8e6"],
    ),
    (
        "paper, Ke 14 MN/m",
        "paper",
        &["mount.stiffness_n_per_m=14e6"],
    ),
    (
        "paper, Ke 40 MN/m",
        "paper",
        &["mount.stiffness_n_per_m=40e6"],
    ),
    ("reduced-vertical", "reduced-vertical", &[]),
    ("in-service", "in-service", &[]),
    (
        "in-service, two chambers",
        "in-service",
        &["two_chamber.vapour_pressure_pa=-9e4"],
    ),
];

/// Step sizes of the accuracy table (s).
pub const STEPS_S: [f64; 2] = [1e-3, 1e-4];

/// Errors of one damper under one excitation.
#[derive(Clone, Debug, Default)]
pub struct Errors {
    /// For each step size of [`STEPS_S`], the NRMSE in `f64` and in `f32`.
    pub nrmse: [[f64; 2]; 2],
    /// Largest force of the reference in extension and in compression (N).
    pub largest_force_n: [f64; 2],
}

impl Errors {
    /// Returns true if the force reached a corner, within the rounding of the reference.
    pub fn reached(&self, corner_n: f64) -> bool {
        let largest = self.largest_force_n[usize::from(corner_n < 0.0)];
        largest >= (1.0 - 1e-9) * corner_n.abs()
    }
}

/// Displacements of the excitation rounded to `f32`, so that both scalars and the reference receive the same motion.
pub fn displacements_m(excitation: Excitation, step_s: f64) -> Vec<f64> {
    let exact = excitation.displacements_m(step_s);
    exact.iter().map(|x| f64::from(*x as f32)).collect()
}

/// Forces of the fixed step (N) over the displacements, starting at rest at the first one.
pub fn stepped<T: Compiled>(
    parameters: &DamperParameters,
    step_s: f64,
    displacements: &[f64],
) -> Vec<f64> {
    let checked = parameters.check().expect("a valid damper");
    let stepped = fixed_step_forces::<T>(&checked, step_s, displacements);
    stepped.expect("a valid step").forces_n
}

/// NRMSE in `f64` and `f32` of one case, and the reference's forces (N).
pub fn errors(
    parameters: &DamperParameters,
    excitation: Excitation,
    step_s: f64,
) -> ([f64; 2], Vec<f64>) {
    let displacements = displacements_m(excitation, step_s);
    let reference = reference_forces(parameters, step_s, &displacements)
        .expect("the reference solves every damper of the table");
    let found = [
        stepped::<f64>(parameters, step_s, &displacements),
        stepped::<f32>(parameters, step_s, &displacements),
    ];
    (found.map(|forces| nrmse(&forces, &reference)), reference)
}

/// Errors of every damper under every excitation, keyed by the names of both.
pub fn measure_all() -> HashMap<(&'static str, &'static str), Errors> {
    let mut cases = Vec::new();
    for (row, preset, overrides) in DAMPERS {
        for excitation in Excitation::ALL {
            for step in [1, 0] {
                cases.push((row, preset, overrides, excitation, step));
            }
        }
    }
    let found = Mutex::new(HashMap::new());
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let &(row, preset, overrides, excitation, step) = case;
                    let parameters = damper(preset, overrides);
                    let (nrmse, forces) = errors(&parameters, excitation, STEPS_S[step]);
                    let mut found = found.lock().expect("no case panicked before");
                    let entry: &mut Errors = found.entry((row, excitation.name())).or_default();
                    entry.nrmse[step] = nrmse;
                    for force in forces {
                        let largest = &mut entry.largest_force_n[usize::from(force < 0.0)];
                        *largest = largest.max(force.abs());
                    }
                }
            });
        }
    });
    found.into_inner().expect("no case panicked")
}
