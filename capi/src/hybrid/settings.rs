//! Settings of a transfer system: defaults, and their types in the core.

use dashpot_core::BuildError;
use dashpot_core::hybrid::{
    AdaptiveSettings, EnergySettings, GuardAction, GuardSettings, InverseModel, TransferSettings,
};

use super::types::{
    DASHPOT_COMPENSATOR_ADAPTIVE, DASHPOT_COMPENSATOR_NONE, DASHPOT_END_HOLD,
    DASHPOT_END_ZERO_FORCE, DashpotAdaptiveSettings, DashpotEnergySettings, DashpotGuardSettings,
    DashpotTransferSettings,
};
use crate::error::DashpotError;
use crate::pointer::{check, exclusive};

/// Delay of an actuator (s), and how much it may differ, before the caller states them.
const DELAY_S: f32 = 0.01;
const DELAY_ERROR_S: f32 = 0.005;

impl From<BuildError> for DashpotError {
    fn from(_: BuildError) -> Self {
        Self::Range
    }
}

/// Fills settings with defaults for an actuator. The compensator is `DASHPOT_COMPENSATOR_NONE`; set another one with
/// `dashpot_transfer_settings_set_delay`. `dashpot_transfer_init` checks all numbers.
///
/// @param settings          written
/// @param stroke_m          largest magnitude of the command (m)
/// @param velocity_m_per_s  largest rate of the command (m/s)
/// @param force_n           largest magnitude of the measured force (N)
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_settings_init(
    settings: *mut DashpotTransferSettings,
    stroke_m: f32,
    velocity_m_per_s: f32,
    force_n: f32,
) -> DashpotError {
    let done = || {
        check(settings)?;
        let guard = GuardSettings::new(stroke_m, velocity_m_per_s, force_n);
        let energy = EnergySettings::default();
        let mut made = DashpotTransferSettings {
            compensator: DASHPOT_COMPENSATOR_NONE,
            polynomial_order: 3,
            polynomial_delay_s: DELAY_S,
            coefficients: [0.0; 4],
            adaptive: DashpotAdaptiveSettings {
                largest_change: [0.0; 4],
                noise_m: 0.0,
                least_motion_m: 0.0,
                pole_hz: 0.0,
                memory_s: 0.0,
                change_s: 0.0,
            },
            guard: DashpotGuardSettings {
                stroke_m: guard.stroke_m,
                velocity_m_per_s: guard.velocity_m_per_s,
                limited_s: guard.limited_s,
                force_n: guard.force_n,
                error_m: guard.error_m,
                error_s: guard.error_s,
                age_s: guard.age_s,
                plausible_m_per_s: guard.plausible_m_per_s,
                plausible_n_per_s: guard.plausible_n_per_s,
                stuck_travel_m: guard.stuck_travel_m,
                least_force_n: guard.least_force_n,
                without_force_m: guard.without_force_m,
                ramp_s: guard.ramp_s,
                approach_m_per_s: guard.approach_m_per_s,
                action: DASHPOT_END_HOLD,
                stiffness_n_per_m: guard.stiffness_n_per_m,
            },
            energy: DashpotEnergySettings {
                window_s: energy.window_s,
                largest_share: energy.largest_share,
                least_power_w: energy.least_power_w,
                pole_hz: energy.pole_hz,
            },
            tracking_window_s: 1.0,
            tracking_error: 0.3,
        };
        set_delay(&mut made, DELAY_S, DELAY_ERROR_S)?;
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { settings.write(made) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Sets the kind of compensator and everything of it for an actuator with a delay: the polynomial's delay, the
/// coefficients of the inverse, and how far an adaptive compensator may change them. All its other settings become the
/// defaults.
///
/// @param settings       from `dashpot_transfer_settings_init`, changed
/// @param compensator    `DASHPOT_COMPENSATOR_...`
/// @param delay_s        delay of the actuator (s), 0 to 0.2
/// @param delay_error_s  largest error of that delay (s), 0 to 0.2; for an adaptive compensator
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_settings_set_delay(
    settings: *mut DashpotTransferSettings,
    compensator: u32,
    delay_s: f32,
    delay_error_s: f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; any bytes are valid settings.
        let settings: &mut DashpotTransferSettings = unsafe { exclusive(settings) }?;
        if compensator > DASHPOT_COMPENSATOR_ADAPTIVE || !(0.0..=0.2).contains(&delay_error_s) {
            return Err(DashpotError::Range);
        }
        set_delay(settings, delay_s, delay_error_s)?;
        settings.compensator = compensator;
        Ok(())
    };
    DashpotError::from(done())
}

/// Fills in everything of the compensators, or nothing after an error.
fn set_delay(
    settings: &mut DashpotTransferSettings,
    delay_s: f32,
    delay_error_s: f32,
) -> Result<(), BuildError> {
    let nominal = InverseModel::of_delay(delay_s)?.coefficients();
    let adaptive = AdaptiveSettings::new(nominal, delay_error_s);
    settings.polynomial_order = 3;
    settings.polynomial_delay_s = delay_s;
    settings.coefficients = nominal;
    settings.adaptive = DashpotAdaptiveSettings {
        largest_change: adaptive.largest_change,
        noise_m: adaptive.noise_m,
        least_motion_m: adaptive.least_motion_m,
        pole_hz: adaptive.pole_hz,
        memory_s: adaptive.memory_s,
        change_s: adaptive.change_s,
    };
    Ok(())
}

/// Settings of an adaptive compensator.
pub(super) fn adaptive(given: &DashpotTransferSettings) -> AdaptiveSettings {
    AdaptiveSettings {
        nominal: given.coefficients,
        largest_change: given.adaptive.largest_change,
        noise_m: given.adaptive.noise_m,
        least_motion_m: given.adaptive.least_motion_m,
        pole_hz: given.adaptive.pole_hz,
        memory_s: given.adaptive.memory_s,
        change_s: given.adaptive.change_s,
    }
}

/// Settings of everything but the compensator.
///
/// # Errors
/// The action of the guard is unknown.
pub(super) fn others(given: &DashpotTransferSettings) -> Result<TransferSettings, BuildError> {
    let (guard, energy) = (&given.guard, &given.energy);
    let action = match guard.action {
        DASHPOT_END_HOLD => GuardAction::Hold,
        DASHPOT_END_ZERO_FORCE => GuardAction::ZeroForce,
        _ => {
            let allowed = "DASHPOT_END_HOLD or DASHPOT_END_ZERO_FORCE";
            return Err(BuildError::new("guard", "action", 0.0, allowed));
        }
    };
    Ok(TransferSettings {
        guard: GuardSettings {
            stroke_m: guard.stroke_m,
            velocity_m_per_s: guard.velocity_m_per_s,
            limited_s: guard.limited_s,
            force_n: guard.force_n,
            error_m: guard.error_m,
            error_s: guard.error_s,
            age_s: guard.age_s,
            plausible_m_per_s: guard.plausible_m_per_s,
            plausible_n_per_s: guard.plausible_n_per_s,
            stuck_travel_m: guard.stuck_travel_m,
            least_force_n: guard.least_force_n,
            without_force_m: guard.without_force_m,
            ramp_s: guard.ramp_s,
            approach_m_per_s: guard.approach_m_per_s,
            action,
            stiffness_n_per_m: guard.stiffness_n_per_m,
        },
        energy: EnergySettings {
            window_s: energy.window_s,
            largest_share: energy.largest_share,
            least_power_w: energy.least_power_w,
            pole_hz: energy.pole_hz,
        },
        tracking_window_s: given.tracking_window_s,
        tracking_error: given.tracking_error,
    })
}
