//! Types of the C interface: storage of known size, and structures of results.

use dashpot_core::health::{Health, HealthModel, HealthStatus};
use dashpot_core::integrity::Check;
use dashpot_core::{Damper, DamperState};

/// Size of a damper (bytes).
pub const DASHPOT_DAMPER_SIZE: usize = size_of::<Damper<f32>>();
/// Size of a damper (words).
pub const DASHPOT_DAMPER_WORDS: usize = DASHPOT_DAMPER_SIZE / size_of::<u32>();
/// Size of a state (bytes).
pub const DASHPOT_STATE_SIZE: usize = size_of::<DamperState<f32>>();
/// Size of a state (words).
pub const DASHPOT_STATE_WORDS: usize = DASHPOT_STATE_SIZE / size_of::<u32>();
/// Size of the image of a damper (bytes).
pub const DASHPOT_IMAGE_SIZE: usize = Damper::<f32>::IMAGE_BYTES;
/// Size of a saved state (bytes).
pub const DASHPOT_SAVED_STATE_SIZE: usize = DamperState::<f32>::SAVED_BYTES;

/// Size of a health model (bytes).
pub const DASHPOT_HEALTH_MODEL_SIZE: usize = size_of::<HealthModel>();
/// Size of a health model (words).
pub const DASHPOT_HEALTH_MODEL_WORDS: usize = DASHPOT_HEALTH_MODEL_SIZE / size_of::<u32>();
/// Size of a health estimate (bytes).
pub const DASHPOT_HEALTH_SIZE: usize = size_of::<Health>();
/// Size of a health estimate (words).
pub const DASHPOT_HEALTH_WORDS: usize = DASHPOT_HEALTH_SIZE / size_of::<u32>();
/// Size of the image of a health model (bytes).
pub const DASHPOT_HEALTH_IMAGE_SIZE: usize = HealthModel::IMAGE_BYTES;

/// Storage of a damper: constants for one step size. Opaque; copy it only as a whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotDamper {
    /// Private.
    pub opaque: [u32; DASHPOT_DAMPER_WORDS],
}

/// Storage of a state, which changes from tick to tick. Opaque; copy it only as a whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotState {
    /// Private.
    pub opaque: [u32; DASHPOT_STATE_WORDS],
}

/// Progress of the check of a damper. Fill it with zeros before the first call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotCheck {
    /// Private.
    pub opaque: [u32; 3],
}

/// Number of calls of `dashpot_check_slice` that check a whole damper.
pub const DASHPOT_CHECK_SLICES: u32 = 777;

// The storage in C has the layout of the types of the core.
const _: () = {
    assert!(size_of::<DashpotDamper>() == size_of::<Damper<f32>>());
    assert!(align_of::<DashpotDamper>() == align_of::<Damper<f32>>());
    assert!(size_of::<DashpotState>() == size_of::<DamperState<f32>>());
    assert!(align_of::<DashpotState>() == align_of::<DamperState<f32>>());
    assert!(size_of::<DashpotCheck>() == size_of::<Check>());
    assert!(align_of::<DashpotCheck>() == align_of::<Check>());
};

/// Properties of a damper.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotDamperInfo {
    /// Step (s): the period for calls of `dashpot_step`.
    pub step_s: f32,
    /// Clearance 2a: the total play (m).
    pub clearance_m: f32,
    /// Largest force magnitude that a step returns (N).
    pub force_limit_n: f32,
    /// Identifier of the constants, never 0: different dampers have different revisions.
    pub revision: u32,
}

/// Readable part of a state.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotReading {
    /// Last displacement used (m), positive in extension.
    pub displacement_m: f32,
    /// Last force returned (N), positive when it resists extension.
    pub force_n: f32,
    /// Latched `DASHPOT_STATUS_...` bits.
    pub status: u16,
    /// Number of ticks at which the displacement was held or limited or the damper restarted, up to 65535.
    pub rejected_inputs: u16,
}

/// A displacement was not finite, out of range, or too far away to catch up with. The last good one was held.
pub const DASHPOT_STATUS_INPUT_HELD: u16 = 1;
/// The displacement changed faster than the configured rate and was followed at that rate.
pub const DASHPOT_STATUS_INPUT_LIMITED: u16 = 2;
/// The element yielded: it reached the saturation force or the configured force limit.
pub const DASHPOT_STATUS_SATURATED: u16 = 4;
/// A different damper stepped this state; the force was carried over.
pub const DASHPOT_STATUS_DAMPER_SWAPPED: u16 = 8;
/// Memory was damaged: the state restarted at rest, or a check found damage in the constants or the state.
pub const DASHPOT_STATUS_CORRUPTED: u16 = 16;
/// A displacement was too far away to catch up with. The damper restarted there at rest and without force.
pub const DASHPOT_STATUS_RESTARTED: u16 = 32;

const _: () = {
    use dashpot_core::Status;
    assert!(DASHPOT_STATUS_INPUT_HELD == Status::INPUT_HELD.bits());
    assert!(DASHPOT_STATUS_INPUT_LIMITED == Status::INPUT_LIMITED.bits());
    assert!(DASHPOT_STATUS_SATURATED == Status::SATURATED.bits());
    assert!(DASHPOT_STATUS_DAMPER_SWAPPED == Status::DAMPER_SWAPPED.bits());
    assert!(DASHPOT_STATUS_CORRUPTED == Status::CORRUPTED.bits());
    assert!(DASHPOT_STATUS_RESTARTED == Status::RESTARTED.bits());
};

/// Storage of a health model: constants of the estimator. Opaque; copy it only as a whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotHealthModel {
    /// Private.
    pub opaque: [u32; DASHPOT_HEALTH_MODEL_WORDS],
}

/// Storage of a health estimate, which changes from tick to tick. Opaque; copy it only as a whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotHealth {
    /// Private.
    pub opaque: [u32; DASHPOT_HEALTH_WORDS],
}

const _: () = {
    assert!(size_of::<DashpotHealthModel>() == size_of::<HealthModel>());
    assert!(align_of::<DashpotHealthModel>() == align_of::<HealthModel>());
    assert!(size_of::<DashpotHealth>() == size_of::<Health>());
    assert!(align_of::<DashpotHealth>() == align_of::<Health>());
};

/// A value and its standard deviation.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotEstimate {
    /// Estimated value.
    pub value: f32,
    /// Standard deviation of the value.
    pub sd: f32,
}

/// Healthy state of a damper with its uncertainty.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotHealthBaseline {
    /// Ratio of the flow to the nominal flow at the same force (1).
    pub flow_factor: DashpotEstimate,
    /// Compliance of the mount, the inverse of its stiffness (m/N).
    pub compliance_m_per_n: DashpotEstimate,
    /// Clearance 2a (m).
    pub clearance_m: DashpotEstimate,
}

/// Alarm limits: allowed differences of an estimate from the baseline. An infinite or NaN limit disables its alarm.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotHealthLimits {
    /// Change of the flow factor in either direction (1); 0.15 in a new model.
    pub flow_factor: f32,
    /// Change of the compliance in either direction, relative to the baseline (1); 0.43 (30 % less stiffness) in a new
    /// model.
    pub compliance: f32,
    /// Change of the clearance in either direction (m); 0.5e-3 in a new model.
    pub clearance_m: f32,
    /// Smallest significant difference, in combined standard deviations of estimate and baseline (1); 5 in a new model.
    pub deviations: f32,
}

/// Present estimates of a damper.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotHealthReading {
    /// Ratio of the flow to the nominal flow at the same force (1). Its inverse is the damping factor.
    pub flow_factor: DashpotEstimate,
    /// Effective stiffness of the mount (N/m).
    pub stiffness_n_per_m: DashpotEstimate,
    /// Clearance 2a: the total play (m).
    pub clearance_m: DashpotEstimate,
    /// Lag of the measured force behind the measured displacement (s).
    pub lag_s: DashpotEstimate,
    /// Compliance of the mount, the inverse of its stiffness (m/N), the quantity that the filter estimates.
    pub compliance_m_per_n: DashpotEstimate,
    /// Number of usable samples: in contact, not yielding.
    pub samples: u32,
    /// Number of samples that were not finite or not credible.
    pub rejected: u32,
    /// `DASHPOT_HEALTH_...` bits.
    pub status: u16,
    /// Zero offset of the force sensor (N). The other estimates are corrected for it.
    pub force_zero_n: DashpotEstimate,
    /// Friction of the seals beyond the nominal one (N). The other estimates are corrected for it.
    pub added_friction_n: DashpotEstimate,
}

/// Alarm, latched: the flow at the same force, and thus the damping, has changed.
pub const DASHPOT_HEALTH_FLOW: u16 = 1;
/// Alarm, latched: the stiffness of the mount has changed.
pub const DASHPOT_HEALTH_STIFFNESS: u16 = 2;
/// Alarm, latched: the clearance has changed.
pub const DASHPOT_HEALTH_CLEARANCE: u16 = 4;
/// There is too little motion in contact for an alarm. Not latched.
pub const DASHPOT_HEALTH_LITTLE_EXCITATION: u16 = 8;
/// Latched: a sample was not finite or not credible and was left out.
pub const DASHPOT_HEALTH_INPUT_REJECTED: u16 = 16;
/// Latched: the estimate was damaged or contradicted the samples for long, and restarted.
pub const DASHPOT_HEALTH_RESTARTED: u16 = 32;
/// Alarm, latched: the damper moved, but the force is zero or does not change. Possible causes are a dead or stuck
/// force channel, oil full of air, or a clearance wider than the motion. Do not trust the estimates.
pub const DASHPOT_HEALTH_NO_FORCE: u16 = 64;
/// Alarm, latched: the force sensor has a zero offset. The estimates are corrected for it.
pub const DASHPOT_HEALTH_FORCE_ZERO: u16 = 128;
/// The lag between the channels is larger than assumed: do not trust stiffness and clearance. Not latched.
pub const DASHPOT_HEALTH_LATE: u16 = 256;
/// Two or three of flow, stiffness and clearance differ from the baseline. A wrong scale, a stuck displacement or a
/// reversed sign of a sensor is a likely cause: do not trust the estimates. Not latched.
pub const DASHPOT_HEALTH_SEVERAL_CHANGED: u16 = 512;
/// The model cannot explain the samples, or the estimate is still converging after a change: do not trust the
/// estimates. Not latched.
pub const DASHPOT_HEALTH_MISFIT: u16 = 1024;

const _: () = {
    assert!(DASHPOT_HEALTH_FLOW == HealthStatus::FLOW.bits());
    assert!(DASHPOT_HEALTH_STIFFNESS == HealthStatus::STIFFNESS.bits());
    assert!(DASHPOT_HEALTH_CLEARANCE == HealthStatus::CLEARANCE.bits());
    assert!(DASHPOT_HEALTH_LITTLE_EXCITATION == HealthStatus::LITTLE_EXCITATION.bits());
    assert!(DASHPOT_HEALTH_INPUT_REJECTED == HealthStatus::INPUT_REJECTED.bits());
    assert!(DASHPOT_HEALTH_RESTARTED == HealthStatus::RESTARTED.bits());
    assert!(DASHPOT_HEALTH_NO_FORCE == HealthStatus::NO_FORCE.bits());
    assert!(DASHPOT_HEALTH_FORCE_ZERO == HealthStatus::FORCE_ZERO.bits());
    assert!(DASHPOT_HEALTH_LATE == HealthStatus::LATE.bits());
    assert!(DASHPOT_HEALTH_SEVERAL_CHANGED == HealthStatus::SEVERAL_CHANGED.bits());
    assert!(DASHPOT_HEALTH_MISFIT == HealthStatus::MISFIT.bits());
};
