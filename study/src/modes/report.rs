//! Results: modes and critical speeds, as rows for reports.

use dashpot_rail::vehicle::Mode;
use serde::Serialize;

/// Modes of a vehicle.
#[derive(Clone, Debug, Serialize)]
pub struct ModesReport {
    /// Name of the vehicle.
    pub vehicle: String,
    /// Axle loads (N).
    pub axle_loads_n: Vec<f64>,
    /// Speed of the modes; `None` at standstill.
    pub speed_km_h: Option<f64>,
    /// Critical speeds, if they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hunting: Option<CriticalSpeeds>,
    /// `None` if the vehicle has no friction elements.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dry_friction: Option<DryFriction>,
    /// Modes in order of frequency; at a speed those below 50 Hz.
    pub modes: Vec<ModeRow>,
}

/// Friction elements in the linear equations.
#[derive(Clone, Debug, Serialize)]
pub struct DryFriction {
    /// Number of elements.
    pub elements: usize,
    /// `sticking` or `sliding`.
    pub linearised_as: &'static str,
}

/// Critical speeds.
#[derive(Clone, Debug, Serialize)]
pub struct CriticalSpeeds {
    /// Speed at which a mode becomes unstable; `None` if none does up to the maximum speed.
    pub critical_speed_km_h: Option<f64>,
    /// Maximum speed of the search.
    pub greatest_speed_km_h: f64,
    /// `None` if a push decays even at the linear critical speed, or at the maximum speed if there is no linear
    /// critical speed. `None` if friction slides, which concerns the linear equations only.
    pub nonlinear_critical_speed_km_h: Option<f64>,
    /// Maximum lateral displacement of a wheelset in the limit cycle at that speed, m.
    pub limit_cycle_m: Option<f64>,
}

/// A mode.
#[derive(Clone, Debug, Serialize)]
pub struct ModeRow {
    /// Bodies that move, and how.
    pub mode: String,
    /// Frequency without damping (Hz).
    pub undamped_hz: f64,
    /// Frequency (Hz).
    pub damped_hz: f64,
    /// Damping ratio (1), negative if the mode grows.
    pub damping_ratio: f64,
}

impl From<&Mode> for ModeRow {
    fn from(mode: &Mode) -> Self {
        Self {
            mode: mode.description(),
            undamped_hz: mode.undamped_hz(),
            damped_hz: mode.damped_hz(),
            damping_ratio: mode.damping_ratio(),
        }
    }
}
