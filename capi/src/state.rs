//! Functions for a state.

use dashpot_core::DamperState;

use crate::damper::made;
use crate::error::DashpotError;
use crate::pointer::{Memory, bytes, check, exclusive, shared};
use crate::types::{DASHPOT_SAVED_STATE_SIZE, DashpotDamper, DashpotReading, DashpotState};

/// Returns an initialised state for reading.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
pub(crate) unsafe fn made_state<'a>(
    state: *const DashpotState,
) -> Result<&'a DamperState<f32>, DashpotError> {
    // SAFETY: the caller keeps the contract; the storage has the layout of `DamperState`, for which any bytes are
    // valid.
    let state: &DamperState<f32> = unsafe { shared(state.cast()) }?;
    if state.is_marked() {
        Ok(state)
    } else {
        Err(DashpotError::NoState)
    }
}

/// Initialises a state at rest, centred in the clearance, without force or status bits.
///
/// @param state           storage with any content; written
/// @param damper          initialised by `dashpot_damper_init`
/// @param displacement_m  displacement (m), finite and within the damper's range
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_init(
    state: *mut DashpotState,
    damper: *const DashpotDamper,
    displacement_m: f32,
) -> DashpotError {
    let done = || {
        check(state)?;
        // SAFETY: the caller keeps the contract.
        let damper = unsafe { made(damper) }?;
        Memory::of(state).check_apart(Memory::of(damper))?;
        let max = damper.largest_displacement_m();
        if !(-max..=max).contains(&displacement_m) {
            return Err(DashpotError::Range);
        }
        // SAFETY: the pointer is checked, and the caller keeps the contract; the storage has the layout of
        // `DamperState`.
        unsafe {
            state
                .cast::<DamperState<f32>>()
                .write(damper.at_rest(displacement_m))
        };
        Ok(())
    };
    DashpotError::from(done())
}

/// Reads displacement, force, status bits and the count of rejected inputs.
///
/// @param state    from `dashpot_state_init` or `dashpot_state_restore`
/// @param reading  written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_read(
    state: *const DashpotState,
    reading: *mut DashpotReading,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let state = unsafe { made_state(state) }?;
        check(reading)?;
        Memory::of(reading).check_apart(Memory::of(state))?;
        let read = DashpotReading {
            displacement_m: state.displacement_m(),
            force_n: state.force_n(),
            status: state.status().bits(),
            rejected_inputs: state.rejected_inputs(),
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { reading.write(read) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Clears the status bits and the count of rejected inputs.
///
/// @param state  from `dashpot_state_init` or `dashpot_state_restore`, changed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_clear_status(state: *mut DashpotState) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; the reference ends with this statement.
        unsafe { made_state(state) }?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `DamperState`.
        let state: &mut DamperState<f32> = unsafe { exclusive(state.cast()) }?;
        state.clear_status();
        Ok(())
    };
    DashpotError::from(done())
}

/// Saves a state as bytes for a file or a link, as `DamperState::save` of dashpot-core does. To keep it in memory, copy
/// the structure.
///
/// @param state   from `dashpot_state_init` or `dashpot_state_restore`
/// @param saved   written, at any alignment
/// @param length  number of bytes, `DASHPOT_SAVED_STATE_SIZE`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_save(
    state: *const DashpotState,
    saved: *mut u8,
    length: usize,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let state = unsafe { made_state(state) }?;
        check(saved)?;
        if length != DASHPOT_SAVED_STATE_SIZE {
            return Err(DashpotError::Length);
        }
        Memory::array(saved, length).check_apart(Memory::of(state))?;
        // SAFETY: the pointer is checked, and the caller keeps the contract; an array of bytes needs no alignment.
        unsafe {
            saved
                .cast::<[u8; DASHPOT_SAVED_STATE_SIZE]>()
                .write(state.save())
        };
        Ok(())
    };
    DashpotError::from(done())
}

/// Restores a saved state. Its next steps are identical to those without saving.
///
/// @param state   storage with any content; written
/// @param damper  the damper that stepped the state last
/// @param saved   bytes from `dashpot_state_save`, at any alignment
/// @param length  number of bytes, `DASHPOT_SAVED_STATE_SIZE`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_restore(
    state: *mut DashpotState,
    damper: *const DashpotDamper,
    saved: *const u8,
    length: usize,
) -> DashpotError {
    let done = || {
        check(state)?;
        // SAFETY: the caller keeps the contract.
        let (damper, saved) = unsafe { (made(damper)?, bytes(saved, length)?) };
        Memory::of(state).check_apart(Memory::of(damper))?;
        Memory::of(state).check_apart(Memory::of_bytes(saved))?;
        let restored = damper.restore(saved)?;
        // SAFETY: the pointer is checked, and the caller keeps the contract; the storage has the layout of
        // `DamperState`.
        unsafe { state.cast::<DamperState<f32>>().write(restored) };
        Ok(())
    };
    DashpotError::from(done())
}
