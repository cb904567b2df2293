//! The damper of these tests.

use std::sync::{Mutex, PoisonError};

use dashpot_core::Damper;
use dashpot_core::parameters::{DamperParameters, Element, Limits, Mount, Reduced};

/// A reduced damper with a clearance, built by the core for 1 ms; once for each damping, for under Miri a build
/// takes seconds.
pub fn core_damper(damping_n_s_per_m: f64) -> Damper<f32> {
    static BUILT: Mutex<Vec<(f64, Damper<f32>)>> = Mutex::new(Vec::new());
    let mut built = BUILT.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, damper)) = built.iter().find(|(of, _)| *of == damping_n_s_per_m) {
        return *damper;
    }
    let parameters = DamperParameters {
        element: Element::Reduced(Reduced {
            damping_n_s_per_m,
            saturation_velocity_m_per_s: 0.03,
        }),
        mount: Mount {
            stiffness_n_per_m: 8e6,
            seat_stiffness_n_per_m: None,
            clearance_m: 1e-3,
        },
        limits: Limits::default(),
    };
    let damper = parameters.build(1e-3).unwrap();
    built.push((damping_n_s_per_m, damper));
    damper
}
