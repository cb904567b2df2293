//! Forces of single dampers and of banks.

use dashpot_core::{Damper, DamperState, Real, step_bank};
use dashpot_files::damper::{self, PRESETS};
use dashpot_testbench::excitation::Excitation;

use crate::bits;

const STEP_S: f64 = 1e-3;

/// Number of ticks of the synthetic ride that drives each damper.
const TICKS: usize = 3000;

/// Dampers of a bank: groups of every size.
const BANK: usize = 31;

/// Each damper of a bank lags the one before it by this number of ticks.
const LAG: usize = 9;

/// Forces of all presets.
pub(super) struct Forces {
    pub single: Vec<String>,
    pub double: Vec<String>,
}

impl Forces {
    /// Each force in single, then in double precision.
    pub(super) fn both(&self) -> Vec<String> {
        let pairs = self.single.iter().zip(&self.double);
        pairs
            .flat_map(|(single, double)| [single.clone(), double.clone()])
            .collect()
    }
}

pub(super) fn forces() -> Forces {
    Forces {
        single: forces_of::<f32>(),
        double: forces_of::<f64>(),
    }
}

fn forces_of<T: Real>() -> Vec<String> {
    let motion = Excitation::Ride.displacements_m(STEP_S);
    let mut results = Vec::new();
    for damper in presets::<T>() {
        let mut state = damper.at_rest(T::from_f64(motion[0]));
        for displacement_m in motion.iter().take(TICKS) {
            let force = damper.step(&mut state, T::from_f64(*displacement_m));
            results.push(bits(force.to_f64()));
        }
    }
    results
}

fn presets<T: Real>() -> Vec<Damper<T>> {
    let built = |(name, _): &(&str, &str)| {
        let parameters = damper::load(name, &[]).expect("a preset");
        parameters.build(STEP_S).expect("a preset")
    };
    PRESETS.iter().map(built).collect()
}

/// Forces of a bank of all presets.
pub(super) fn bank<T: Real>() -> Vec<String> {
    let motion = Excitation::Ride.displacements_m(STEP_S);
    let presets = presets::<T>();
    let dampers: [&Damper<T>; BANK] = std::array::from_fn(|lane| &presets[lane % presets.len()]);
    let at = |lane: usize, tick: usize| T::from_f64(motion[(tick + LAG * lane) % motion.len()]);
    let mut states: [DamperState<T>; BANK] =
        std::array::from_fn(|lane| dampers[lane].at_rest(at(lane, 0)));
    let mut forces = [T::ZERO; BANK];
    let mut results = Vec::new();
    for tick in 0..TICKS {
        let displacements = std::array::from_fn(|lane| at(lane, tick));
        step_bank(&dampers, &mut states, &displacements, &mut forces);
        results.extend(forces.map(|force| bits(force.to_f64())));
    }
    results
}
