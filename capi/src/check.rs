//! Slow check of constants and a state in memory.

use dashpot_core::integrity::{Check, Corrupted, SLICES};

use crate::damper::made;
use crate::error::DashpotError;
use crate::pointer::{Memory, exclusive};
use crate::state::made_state;
use crate::types::{DashpotCheck, DashpotDamper, DashpotState};

const _: () = assert!(crate::types::DASHPOT_CHECK_SLICES == SLICES);

impl From<Corrupted> for DashpotError {
    fn from(_: Corrupted) -> Self {
        Self::Corrupted
    }
}

/// Checks a slice of a damper's constants and a state. Call it at every tick or less often.
///
/// `DASHPOT_CHECK_SLICES` calls are one round, which checks all constants. A flipped bit is found in the next round. To
/// hold a force from before the damage, store the force at the first call of each round, and use the one stored in the
/// last round that ended without an error. Between calls you may load the damper again or set its clearance. A call
/// takes at most about 390 instructions on a Cortex-M7.
///
/// @param damper  initialised by `dashpot_damper_init`
/// @param state   a state of this damper
/// @param check   progress of the check of this damper, changed; fill it with zeros before the first call
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_check_slice(
    damper: *const DashpotDamper,
    state: *const DashpotState,
    check: *mut DashpotCheck,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let (damper, state) = unsafe { (made(damper)?, made_state(state)?) };
        crate::pointer::check(check)?;
        Memory::of(check).check_apart(Memory::of(damper))?;
        Memory::of(check).check_apart(Memory::of(state))?;
        // SAFETY: the pointer is checked, and the caller keeps the contract; the storage has the layout of `Check`, for
        // which any bytes are valid.
        let check: &mut Check = unsafe { exclusive(check.cast()) }?;
        check.slice(damper)?;
        Check::state(damper, state)?;
        Ok(())
    };
    DashpotError::from(done())
}
