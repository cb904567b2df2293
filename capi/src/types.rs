//! What C declares: storage of known size, and the structures that are read.

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
    /// Ticks whose displacement was held or limited, up to 65535.
    pub rejected_inputs: u16,
}

/// A displacement was NaN or infinite; the last good one was held.
pub const DASHPOT_STATUS_INPUT_HELD: u16 = 1;
/// A displacement moved faster than the configured rate; it was followed at that rate.
pub const DASHPOT_STATUS_INPUT_LIMITED: u16 = 2;
/// The element yielded: saturation force or configured force limit reached.
pub const DASHPOT_STATUS_SATURATED: u16 = 4;
/// Another damper than before stepped this state; the force was carried over.
pub const DASHPOT_STATUS_DAMPER_SWAPPED: u16 = 8;
/// Memory was damaged: the state started over at rest, or a check found damage in constants or state.
pub const DASHPOT_STATUS_CORRUPTED: u16 = 16;

const _: () = {
    use dashpot_core::Status;
    assert!(DASHPOT_STATUS_INPUT_HELD == Status::INPUT_HELD.bits());
    assert!(DASHPOT_STATUS_INPUT_LIMITED == Status::INPUT_LIMITED.bits());
    assert!(DASHPOT_STATUS_SATURATED == Status::SATURATED.bits());
    assert!(DASHPOT_STATUS_DAMPER_SWAPPED == Status::DAMPER_SWAPPED.bits());
    assert!(DASHPOT_STATUS_CORRUPTED == Status::CORRUPTED.bits());
};
