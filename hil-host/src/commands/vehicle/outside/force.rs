//! Force of an external damper on the vehicle.

use dashpot_vehicle_run::{Run, VehicleRunError};

/// Sets the force of a damper from the next tick on.
pub(super) fn set_force_n(
    run: &mut Run,
    damper: usize,
    force_n: f64,
) -> Result<(), VehicleRunError> {
    Ok(run.state_mut().set_outside_force_n(damper, Some(force_n))?)
}
