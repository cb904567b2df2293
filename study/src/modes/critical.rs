//! Modes at a speed, and the speed at which one becomes unstable.

use dashpot_rail::vehicle::{Mode, Running, VehicleError, VehicleParameters};

use super::Contact;

/// Maximum speed and step of the search for a critical speed, km/h.
pub(super) const MAX_SEARCH_KM_H: f64 = 500.0;
const SEARCH_STEP_KM_H: f64 = 10.0;

/// A mode is unstable if it grows by more than this part of its frequency. Rounding gives the modes of a vehicle
/// without dampers a small damping of either sign.
pub const MIN_GROWTH: f64 = 1e-9;

/// Computes the modes at a speed.
pub(super) fn modes_at(
    vehicle: &VehicleParameters,
    contacts: &[&Contact],
    km_h: f64,
) -> Result<Vec<Mode>, VehicleError> {
    Running::with_contacts(vehicle, contacts, km_h / 3.6)?.modes()
}

/// Finds the lowest speed at which a mode is unstable: search in steps, then bisection to 0.01 km/h.
pub(super) fn critical_speed_km_h(
    vehicle: &VehicleParameters,
    contacts: &[&Contact],
) -> Result<Option<f64>, VehicleError> {
    let grows = |km_h: f64| -> Result<bool, VehicleError> {
        let modes = modes_at(vehicle, contacts, km_h)?;
        Ok(modes.iter().any(|mode| mode.damping_ratio() < -MIN_GROWTH))
    };
    let mut stable = 0.0;
    while stable < MAX_SEARCH_KM_H {
        let mut growing = stable + SEARCH_STEP_KM_H;
        if grows(growing)? {
            while growing - stable > 0.01 {
                let middle = 0.5 * (stable + growing);
                if grows(middle)? {
                    growing = middle;
                } else {
                    stable = middle;
                }
            }
            return Ok(Some(growing));
        }
        stable = growing;
    }
    Ok(None)
}
