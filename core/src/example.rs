//! A damper for the tests of this crate.

use crate::parameters::{DamperParameters, Mount};

/// The reduced vertical damper: 120 kN s/m up to 0.03 m/s, 8 MN/m, clearance 1 mm.
pub(crate) fn reduced_vertical() -> DamperParameters {
    let mount = Mount::new(8e6).clearance_m(1e-3);
    DamperParameters::reduced(120e3, 0.03, mount)
}
