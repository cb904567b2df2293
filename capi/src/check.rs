//! The slow check of constants and a state in memory.

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

/// Checks a slice of a damper's constants and a state: call it at every tick, or slower.
///
/// `DASHPOT_CHECK_SLICES` calls check the constants whole, then it begins again. A flipped bit is found within
/// the round that begins after it. To hold a force then, keep that of the tick of each round's first call; the one kept
/// when the last round ended without an error was made before the damage. Loading the damper or setting its
/// clearance between calls is no damage. Some 370 instructions at most on a Cortex-M7.
///
/// @param damper  made by `dashpot_damper_init`
/// @param state   made for it
/// @param check   how far the check of this damper has come; zeros before the first call, changed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_check_slice(
    damper: *const DashpotDamper,
    state: *const DashpotState,
    check: *mut DashpotCheck,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise.
        let (damper, state) = unsafe { (made(damper)?, made_state(state)?) };
        crate::pointer::check(check)?;
        Memory::of(check).check_apart(Memory::of(damper))?;
        Memory::of(check).check_apart(Memory::of(state))?;
        // SAFETY: checked, and the caller's promise; the storage is a Check's to the byte, any bytes are one.
        let check: &mut Check = unsafe { exclusive(check.cast()) }?;
        check.slice(damper)?;
        Check::state(damper, state)?;
        Ok(())
    };
    DashpotError::from(done())
}
