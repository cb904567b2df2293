//! Damper for the tests.

use std::sync::{Mutex, PoisonError};

use dashpot_core::Damper;
use dashpot_core::parameters::{DamperParameters, Mount};

/// Returns a reduced damper with a clearance for a step of 1 ms. It is built once for each damping, because a build
/// takes seconds under Miri.
pub fn core_damper(damping_n_s_per_m: f64) -> Damper<f32> {
    static BUILT: Mutex<Vec<(f64, Damper<f32>)>> = Mutex::new(Vec::new());
    let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, damper)) = built
        .iter()
        .find(|(damping, _)| *damping == damping_n_s_per_m)
    {
        return *damper;
    }
    let mount = Mount::new(8e6).clearance_m(1e-3);
    let parameters = DamperParameters::reduced(damping_n_s_per_m, 0.03, mount);
    let damper = parameters.build(1e-3).unwrap();
    built.push((damping_n_s_per_m, damper));
    damper
}
