//! A damper for the tests of this crate.

use crate::parameters::{DamperParameters, Element, Limits, Mount, Reduced};

/// The reduced vertical damper: 120 kN s/m up to 0.03 m/s, 8 MN/m, clearance 1 mm.
pub(crate) fn reduced_vertical() -> DamperParameters {
    DamperParameters {
        element: Element::Reduced(Reduced {
            damping_n_s_per_m: 120e3,
            saturation_velocity_m_per_s: 0.03,
        }),
        mount: Mount {
            stiffness_n_per_m: 8e6,
            seat_stiffness_n_per_m: None,
            clearance_m: 1e-3,
        },
        limits: Limits::default(),
    }
}
