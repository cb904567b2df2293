//! What C declares: storage of known size, and the structures that are read.

use dashpot_core::health::{Health, HealthModel, HealthStatus};
use dashpot_core::integrity::Check;
use dashpot_core::{Damper, DamperState};

/// Bytes of a damper.
pub const DASHPOT_DAMPER_SIZE: usize = size_of::<Damper<f32>>();
/// Words of a damper.
pub const DASHPOT_DAMPER_WORDS: usize = DASHPOT_DAMPER_SIZE / size_of::<u32>();
/// Bytes of a state.
pub const DASHPOT_STATE_SIZE: usize = size_of::<DamperState<f32>>();
/// Words of a state.
pub const DASHPOT_STATE_WORDS: usize = DASHPOT_STATE_SIZE / size_of::<u32>();
/// Bytes of an image, from which a damper is made.
pub const DASHPOT_IMAGE_SIZE: usize = Damper::<f32>::IMAGE_BYTES;
/// Bytes of a saved state.
pub const DASHPOT_SAVED_STATE_SIZE: usize = DamperState::<f32>::SAVED_BYTES;

/// Bytes of the constants of an estimator of health.
pub const DASHPOT_HEALTH_MODEL_SIZE: usize = size_of::<HealthModel>();
/// Words of them.
pub const DASHPOT_HEALTH_MODEL_WORDS: usize = DASHPOT_HEALTH_MODEL_SIZE / size_of::<u32>();
/// Bytes of an estimate of health.
pub const DASHPOT_HEALTH_SIZE: usize = size_of::<Health>();
/// Words of it.
pub const DASHPOT_HEALTH_WORDS: usize = DASHPOT_HEALTH_SIZE / size_of::<u32>();
/// Bytes of an image, from which the constants of an estimator of health are made.
pub const DASHPOT_HEALTH_IMAGE_SIZE: usize = HealthModel::IMAGE_BYTES;

/// Storage of a built damper: constants for one step size. Opaque; may be copied whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotDamper {
    /// Not for use.
    pub opaque: [u32; DASHPOT_DAMPER_WORDS],
}

/// Storage of what changes from tick to tick. Opaque; may be copied whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotState {
    /// Not for use.
    pub opaque: [u32; DASHPOT_STATE_WORDS],
}

/// How far the check of a damper has come: zeros before the first call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotCheck {
    /// Not for use.
    pub opaque: [u32; 3],
}

/// Calls of `dashpot_check_slice` that check a damper whole.
pub const DASHPOT_CHECK_SLICES: u32 = 769;

// The storage C declares is the core's own, to the byte.
const _: () = {
    assert!(size_of::<DashpotDamper>() == size_of::<Damper<f32>>());
    assert!(align_of::<DashpotDamper>() == align_of::<Damper<f32>>());
    assert!(size_of::<DashpotState>() == size_of::<DamperState<f32>>());
    assert!(align_of::<DashpotState>() == align_of::<DamperState<f32>>());
    assert!(size_of::<DashpotCheck>() == size_of::<Check>());
    assert!(align_of::<DashpotCheck>() == align_of::<Check>());
};

/// What a damper was built for.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotDamperInfo {
    /// Step (s): call `dashpot_step` once in each.
    pub step_s: f32,
    /// Clearance 2a, the whole play (m).
    pub clearance_m: f32,
    /// Largest force magnitude that a step returns (N).
    pub force_limit_n: f32,
    /// Number that tells built dampers apart, never 0.
    pub revision: u32,
}

/// What a state holds for others to read.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotReading {
    /// Displacement used last (m).
    pub displacement_m: f32,
    /// Force returned last (N).
    pub force_n: f32,
    /// `DASHPOT_STATUS_...` bits latched since they were last cleared.
    pub status: u16,
    /// Ticks whose displacement was held or limited, or at which the damper restarted, up to 65535.
    pub rejected_inputs: u16,
}

/// A displacement was not finite, out of range, or too far from the last one to catch up with; the last good one was held.
pub const DASHPOT_STATUS_INPUT_HELD: u16 = 1;
/// A displacement moved faster than the configured rate; it was followed at that rate.
pub const DASHPOT_STATUS_INPUT_LIMITED: u16 = 2;
/// The element yielded: saturation force or configured force limit reached.
pub const DASHPOT_STATUS_SATURATED: u16 = 4;
/// Another damper than before stepped this state; the force was carried over.
pub const DASHPOT_STATUS_DAMPER_SWAPPED: u16 = 8;
/// Memory was damaged: the state started over at rest, or a check found damage in constants or state.
pub const DASHPOT_STATUS_CORRUPTED: u16 = 16;
/// A displacement was too far from the last one to catch up with: the damper restarted at rest there, without force.
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

/// Storage of the constants of an estimator of health. Opaque; may be copied whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotHealthModel {
    /// Not for use.
    pub opaque: [u32; DASHPOT_HEALTH_MODEL_WORDS],
}

/// Storage of an estimate of health, what changes from tick to tick. Opaque; may be copied whole.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DashpotHealth {
    /// Not for use.
    pub opaque: [u32; DASHPOT_HEALTH_WORDS],
}

const _: () = {
    assert!(size_of::<DashpotHealthModel>() == size_of::<HealthModel>());
    assert!(align_of::<DashpotHealthModel>() == align_of::<HealthModel>());
    assert!(size_of::<DashpotHealth>() == size_of::<Health>());
    assert!(align_of::<DashpotHealth>() == align_of::<Health>());
};

/// A number and the standard deviation with which it is known.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotEstimate {
    /// The number.
    pub value: f32,
    /// Its standard deviation.
    pub sd: f32,
}

/// What a damper was when it was healthy.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotHealthBaseline {
    /// Flow over nominal flow at the same force (1).
    pub flow_factor: DashpotEstimate,
    /// Compliance of the mount, one over its stiffness (m/N).
    pub compliance_m_per_n: DashpotEstimate,
    /// Clearance 2a (m).
    pub clearance_m: DashpotEstimate,
}

/// How far an estimate may lie from the baseline before an alarm; a limit of infinity or NaN never alarms.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotHealthLimits {
    /// Change of the flow factor either way (1); 0.15 in a model as it was built.
    pub flow_factor: f32,
    /// Change of the compliance either way, over that of the baseline (1); 0.43, which is a stiffness 30 % lower.
    pub compliance: f32,
    /// Change of the clearance either way (m); 0.5e-3.
    pub clearance_m: f32,
    /// Standard deviations, of estimate and baseline together, by which it must differ too (1); 5.
    pub deviations: f32,
}

/// What is known of a damper now.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DashpotHealthReading {
    /// Flow over nominal flow at the same force (1); its inverse is the damping factor.
    pub flow_factor: DashpotEstimate,
    /// Effective stiffness of the mount (N/m).
    pub stiffness_n_per_m: DashpotEstimate,
    /// Clearance 2a, the whole play (m).
    pub clearance_m: DashpotEstimate,
    /// Lag of the measured force behind the measured displacement (s).
    pub lag_s: DashpotEstimate,
    /// Compliance of the mount, one over its stiffness (m/N), which is what is estimated.
    pub compliance_m_per_n: DashpotEstimate,
    /// Samples that told something: in contact, not yielding.
    pub samples: u32,
    /// Samples that were not finite or not credible.
    pub rejected: u32,
    /// `DASHPOT_HEALTH_...` bits.
    pub status: u16,
    /// Zero of the force sensor: force that is measured where there is none (N). The others are corrected for it.
    pub force_zero_n: DashpotEstimate,
    /// Friction of the seals beyond the nominal one (N). The others are corrected for it.
    pub added_friction_n: DashpotEstimate,
}

/// Flow at the same force, and with it damping, has changed: alarm, latched.
pub const DASHPOT_HEALTH_FLOW: u16 = 1;
/// The stiffness of the mount has changed: alarm, latched.
pub const DASHPOT_HEALTH_STIFFNESS: u16 = 2;
/// The clearance has changed: alarm, latched.
pub const DASHPOT_HEALTH_CLEARANCE: u16 = 4;
/// Not enough is known now for an alarm: too little motion in contact. Not latched.
pub const DASHPOT_HEALTH_LITTLE_EXCITATION: u16 = 8;
/// A sample was not finite or not credible and was left out; latched.
pub const DASHPOT_HEALTH_INPUT_REJECTED: u16 = 16;
/// The estimate was damaged or contradicted for long, and began anew; latched.
pub const DASHPOT_HEALTH_RESTARTED: u16 = 32;
/// The damper moved and the force did not follow: a dead or stuck force channel, oil full of air, a clearance wider than
/// the motion: alarm, latched. Do not trust the estimates.
pub const DASHPOT_HEALTH_NO_FORCE: u16 = 64;
/// The zero of the force sensor is off: alarm, latched. The estimates are corrected for it.
pub const DASHPOT_HEALTH_FORCE_ZERO: u16 = 128;
/// The channels are further apart in time than is known beforehand: do not trust stiffness and clearance. Not latched.
pub const DASHPOT_HEALTH_LATE: u16 = 256;
/// Two or three of flow, stiffness and clearance differ from the baseline, as with a wrong scale of a sensor, a stuck
/// displacement or a reversed sign: do not trust the estimates. Not latched.
pub const DASHPOT_HEALTH_SEVERAL_CHANGED: u16 = 512;
/// What is measured does not follow from the model, or the estimate is still on its way after a change: do not trust
/// the estimates. Not latched.
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
