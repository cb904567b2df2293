//! Types of a hybrid test: storage of known size, settings, inputs and results.

use dashpot_core::hybrid::HybridStatus;

/// Size of a transfer system in units of 8 bytes. A 64-bit processor needs all of it, a 32-bit processor less.
pub const DASHPOT_TRANSFER_UNITS: usize = 426;
/// Size of a motion filter (words).
pub const DASHPOT_MOTION_FILTER_WORDS: usize = 6;

/// Storage of a transfer system: compensator, tracking, energy and guard. Opaque; copy it only as a whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotTransfer {
    /// Private.
    pub opaque: [u64; DASHPOT_TRANSFER_UNITS],
}

/// Storage of a motion filter. Opaque; copy it only as a whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotMotionFilter {
    /// Private.
    pub opaque: [u32; DASHPOT_MOTION_FILTER_WORDS],
}

/// Displacement of the damper's ends at a tick, and its derivatives. Positive in extension.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotMotion {
    /// Displacement (m).
    pub displacement_m: f32,
    /// Velocity (m/s).
    pub velocity_m_per_s: f32,
    /// Acceleration (m/s^2).
    pub acceleration_m_per_s2: f32,
    /// Jerk (m/s^3).
    pub jerk_m_per_s3: f32,
}

/// Measured values of a tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotMeasured {
    /// Displacement of the damper's ends (m), positive in extension.
    pub displacement_m: f32,
    /// Force of the damper (N), positive when it resists extension.
    pub force_n: f32,
}

/// Result of a tick.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotCommand {
    /// Command of the actuator (m).
    pub command_m: f32,
    /// Force for the vehicle (N): the measured one, or the last valid one; after the end of a test it fades to 0.
    pub force_n: f32,
    /// Latched `DASHPOT_HYBRID_...` bits.
    pub status: u16,
    /// Phase of the test after the tick, `DASHPOT_PHASE_...`.
    pub phase: u16,
}

/// Compensator: the desired displacement is sent as it is.
pub const DASHPOT_COMPENSATOR_NONE: u32 = 0;
/// Compensator: the polynomial through the last displacements, one known delay ahead.
pub const DASHPOT_COMPENSATOR_POLYNOMIAL: u32 = 1;
/// Compensator: displacement and derivatives times fixed coefficients.
pub const DASHPOT_COMPENSATOR_INVERSE: u32 = 2;
/// Compensator: the same with coefficients that follow the actuator.
pub const DASHPOT_COMPENSATOR_ADAPTIVE: u32 = 3;

/// End of a test: stop, and hold the displacement.
pub const DASHPOT_END_HOLD: u32 = 0;
/// End of a test: stop, and move back by the measured force divided by the stiffness of the specimen.
pub const DASHPOT_END_ZERO_FORCE: u32 = 1;

/// The command moves slowly to the desired displacement.
pub const DASHPOT_PHASE_APPROACHING: u16 = 0;
/// The command follows the wanted one.
pub const DASHPOT_PHASE_RUNNING: u16 = 1;
/// The test has ended, and the command comes to rest.
pub const DASHPOT_PHASE_ENDING: u16 = 2;
/// The test has ended, and the command stays.
pub const DASHPOT_PHASE_HELD: u16 = 3;

/// How an adaptive compensator learns.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotAdaptiveSettings {
    /// Largest change of each coefficient in either direction, 1 to s^3; 0 keeps a coefficient. At most 0.5, 0.2 s,
    /// 0.02 s^2 and 0.002 s^3.
    pub largest_change: [f32; 4],
    /// Misfit of command and measurement that says nothing about the coefficients (m), root mean square; 1e-7 to 0.01.
    pub noise_m: f32,
    /// Motion below which the coefficients are frozen (m), 0 to 1: velocity over the pole of the filters.
    pub least_motion_m: f32,
    /// Pole of the low-pass filters before the comparison (Hz), 0.1 to 1000 and to a tenth of the rate of the ticks.
    pub pole_hz: f32,
    /// Time after which a past motion counts 1/e (s), 0.1 to 1000.
    pub memory_s: f32,
    /// Shortest time for the largest change of a coefficient (s), 0.01 to 1000.
    pub change_s: f32,
}

/// Limits of a test.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotGuardSettings {
    /// Largest magnitude of the command (m), 1e-4 to 1.
    pub stroke_m: f32,
    /// Largest rate of the command (m/s), 1e-3 to 10. A faster command is limited.
    pub velocity_m_per_s: f32,
    /// Time for which the command may be limited without a break (s), 0 to 10.
    pub limited_s: f32,
    /// Largest magnitude of the measured force (N), 1 to 1e7.
    pub force_n: f32,
    /// Largest difference between measured and desired displacement (m), 1e-5 to 1.
    pub error_m: f32,
    /// Time for which the difference may be larger (s), 0 to 10.
    pub error_s: f32,
    /// Longest time without a valid measurement (s), 0 to 10.
    pub age_s: f32,
    /// Largest rate of a measured displacement that is plausible (m/s), 1e-3 to 1000.
    pub plausible_m_per_s: f32,
    /// Largest rate of a measured force that is plausible (N/s), 1 to 1e12.
    pub plausible_n_per_s: f32,
    /// Travel of the command (m) during which a measured value may stay the same to the last bit, 1e-6 to 1.
    pub stuck_travel_m: f32,
    /// Magnitude of the measured force below which the specimen counts as one without force (N), 0 to 1e7; 0 switches
    /// the check off.
    pub least_force_n: f32,
    /// Travel of the command (m) during which the specimen may be without force, 1e-6 to 100.
    pub without_force_m: f32,
    /// Time in which the command comes to rest (s), 0.01 to 10.
    pub ramp_s: f32,
    /// Rate at which the command approaches the desired displacement at the start (m/s), 1e-4 to 1.
    pub approach_m_per_s: f32,
    /// How a test ends, `DASHPOT_END_...`.
    pub action: u32,
    /// Stiffness of the specimen, for `DASHPOT_END_ZERO_FORCE` (N/m), 1e3 to 1e12.
    pub stiffness_n_per_m: f32,
}

/// Alarm of the energy that the actuator adds to the vehicle.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotEnergySettings {
    /// Time after which past energy counts 1/e (s), 0.05 to 1000.
    pub window_s: f32,
    /// Energy added in this time that is an alarm, as a share of the energy that the damper exchanges; 0.01 to 100.
    pub largest_share: f32,
    /// Mean exchanged power below which there is no alarm (W), 0 to 1e6.
    pub least_power_w: f32,
    /// Pole of the low-pass filters of displacement and force (Hz), 1 to 1000 and to a tenth of the rate of the ticks.
    pub pole_hz: f32,
}

/// Settings of a transfer system. Fill them with `dashpot_transfer_settings_init`, then change what differs.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotTransferSettings {
    /// Kind of compensator, `DASHPOT_COMPENSATOR_...`.
    pub compensator: u32,
    /// Order of the polynomial, 1 to 3.
    pub polynomial_order: u32,
    /// Delay that the polynomial corrects (s), 1 to 256 ticks.
    pub polynomial_delay_s: f32,
    /// Coefficients of the inverse, or those of an adaptive compensator at the start: 1 (0.2 to 5), s (-0.2 to 0.2),
    /// s^2 (-0.02 to 0.02) and s^3 (-0.002 to 0.002).
    pub coefficients: [f32; 4],
    /// How an adaptive compensator learns.
    pub adaptive: DashpotAdaptiveSettings,
    /// Limits of the test.
    pub guard: DashpotGuardSettings,
    /// Alarm of the added energy.
    pub energy: DashpotEnergySettings,
    /// Time after which past motion counts 1/e in the tracking (s), 0.05 to 1000.
    pub tracking_window_s: f32,
    /// Error of the tracking over that window that ends a test, relative to the desired motion (1), 0.01 to 100.
    pub tracking_error: f32,
}

/// Tracking, energy and compensator of a transfer system.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotTransferReading {
    /// Time by which the measured displacement is late (s); negative if it is early.
    pub delay_s: f32,
    /// Amplitude of the measured displacement relative to the desired one (1).
    pub amplitude: f32,
    /// Root mean square of measured minus desired displacement, relative to that of the desired one (1).
    pub relative_error: f32,
    /// Root mean square of measured minus desired displacement (m).
    pub error_m: f32,
    /// Energy that the actuator has added to the vehicle since the start (J); negative if it took energy away.
    pub added_j: f32,
    /// Share of the exchanged energy that the actuator added over the fading past (1).
    pub added_share: f32,
    /// Present coefficients of an inverse or adaptive compensator, 1 to s^3; 1, 0, 0, 0 for the other kinds.
    pub coefficients: [f32; 4],
    /// 1 if the coefficients do not change: too little motion, or another kind of compensator; else 0.
    pub is_frozen: u32,
}

/// The command would have moved faster than its rate limit, and was limited. Does not end a test.
pub const DASHPOT_HYBRID_COMMAND_LIMITED: u16 = 1;
/// At least one tick had no valid measurement. Does not end a test.
pub const DASHPOT_HYBRID_MEASUREMENT_MISSED: u16 = 2;
/// The desired displacement, or the compensator's command, was not a number or beyond the stroke.
pub const DASHPOT_HYBRID_STROKE: u16 = 4;
/// The command was limited for too long.
pub const DASHPOT_HYBRID_VELOCITY: u16 = 8;
/// The measured force was beyond its limit.
pub const DASHPOT_HYBRID_FORCE: u16 = 16;
/// Measured and desired displacement were too far apart for too long, or for a large part of the motion.
pub const DASHPOT_HYBRID_TRACKING: u16 = 32;
/// Measured values were too old.
pub const DASHPOT_HYBRID_AGE: u16 = 64;
/// A measured value jumped, was not a number, or did not change for too long while the command moved.
pub const DASHPOT_HYBRID_IMPLAUSIBLE: u16 = 128;
/// The force pushed in the direction of the motion: a wrong sign, or a specimen that is driven.
pub const DASHPOT_HYBRID_SIGN: u16 = 256;
/// The actuator added too much energy to the vehicle.
pub const DASHPOT_HYBRID_ENERGY: u16 = 512;
/// `dashpot_transfer_end` was called.
pub const DASHPOT_HYBRID_REQUESTED: u16 = 1024;
/// The specimen moved far without a force worth the name: it is broken, or not connected.
pub const DASHPOT_HYBRID_NO_FORCE: u16 = 2048;

const _: () = {
    assert!(DASHPOT_HYBRID_COMMAND_LIMITED == HybridStatus::COMMAND_LIMITED.bits());
    assert!(DASHPOT_HYBRID_MEASUREMENT_MISSED == HybridStatus::MEASUREMENT_MISSED.bits());
    assert!(DASHPOT_HYBRID_STROKE == HybridStatus::STROKE.bits());
    assert!(DASHPOT_HYBRID_VELOCITY == HybridStatus::VELOCITY.bits());
    assert!(DASHPOT_HYBRID_FORCE == HybridStatus::FORCE.bits());
    assert!(DASHPOT_HYBRID_TRACKING == HybridStatus::TRACKING.bits());
    assert!(DASHPOT_HYBRID_AGE == HybridStatus::AGE.bits());
    assert!(DASHPOT_HYBRID_IMPLAUSIBLE == HybridStatus::IMPLAUSIBLE.bits());
    assert!(DASHPOT_HYBRID_SIGN == HybridStatus::SIGN.bits());
    assert!(DASHPOT_HYBRID_ENERGY == HybridStatus::ENERGY.bits());
    assert!(DASHPOT_HYBRID_REQUESTED == HybridStatus::REQUESTED.bits());
    assert!(DASHPOT_HYBRID_NO_FORCE == HybridStatus::NO_FORCE.bits());
    assert!(HybridStatus::all().bits() == 2 * DASHPOT_HYBRID_NO_FORCE - 1);
};
