//! The functions that C calls. Each checks all it was given, then does its work, or nothing.
//!
//! What a caller promises in every function: a pointer that is neither null nor misaligned points to
//! storage of its type, or to as many bytes or elements as the length or count says; nobody else
//! changes that storage during the call, or uses it where the call changes it.
#![allow(clippy::missing_safety_doc)] // stated once, above, and in the header

use dashpot_core::parameters::LARGEST_CLEARANCE_M;
use dashpot_core::{Damper, DamperState};

use crate::error::DashpotError;
use crate::pointer::{bytes, check, check_count, exclusive, shared};
use crate::saved;
use crate::types::{DashpotDamper, DashpotDamperInfo, DashpotReading, DashpotState};

/// A damper that was made from an image.
///
/// # Safety
/// As above.
unsafe fn made<'a>(damper: *const DashpotDamper) -> Result<&'a Damper<f32>, DashpotError> {
    // SAFETY: the caller's promise; the storage is a Damper's to the byte and any bytes are one.
    let damper: &Damper<f32> = unsafe { shared(damper.cast()) }?;
    if damper.revision() == 0 {
        Err(DashpotError::NoDamper)
    } else {
        Ok(damper)
    }
}

/// Makes a damper from an image: the bytes that `dashpot export --lang c` or `--lang bin` wrote.
///
/// The image is checked whole first and not needed afterwards. A state that this damper stepped before
/// is carried over at its next step, its force kept. Some 740 000 instructions on a Cortex-M7: not for a tick.
///
/// @param damper  storage, its content does not matter
/// @param image   the bytes, at any alignment
/// @param length  number of bytes, `DASHPOT_IMAGE_SIZE`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_damper_init(
    damper: *mut DashpotDamper,
    image: *const u8,
    length: usize,
) -> DashpotError {
    let done = || {
        check(damper)?;
        // SAFETY: the caller's promise.
        let image = unsafe { bytes(image, length) }?;
        Damper::<f32>::check_image(image)?;
        // SAFETY: checked, and the caller's promise; zeros are a Damper, so it may be referred to.
        let damper: &mut Damper<f32> = unsafe {
            damper.write_bytes(0, 1);
            exclusive(damper.cast())
        }?;
        Ok(damper.load_image(image)?)
    };
    DashpotError::from(done())
}

/// Reads what a damper was built for: compare `step_s` with your tick.
///
/// @param damper  made by `dashpot_damper_init`
/// @param info    written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_damper_describe(
    damper: *const DashpotDamper,
    info: *mut DashpotDamperInfo,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise.
        let damper = unsafe { made(damper) }?;
        check(info)?;
        let read = DashpotDamperInfo {
            step_s: damper.step_s(),
            clearance_m: damper.clearance_m(),
            force_limit_n: damper.force_limit_n(),
            revision: damper.revision(),
        };
        // SAFETY: checked, and the caller's promise.
        unsafe { info.write(read) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Sets the clearance of a damper that is in use: its states are carried over at their next step, the
/// force kept. On a Cortex-M7 some 320 instructions here, some 1500 more in the next step of each state.
///
/// @param damper       made by `dashpot_damper_init`; no step may run on it meanwhile
/// @param clearance_m  clearance 2a, the whole play (m), 0 to 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_damper_set_clearance(
    damper: *mut DashpotDamper,
    clearance_m: f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise; the reference ends here.
        unsafe { made(damper) }?;
        if !(0.0..=LARGEST_CLEARANCE_M as f32).contains(&clearance_m) {
            return Err(DashpotError::Range);
        }
        // SAFETY: the caller's promise; the storage is a Damper's to the byte.
        let damper: &mut Damper<f32> = unsafe { exclusive(damper.cast()) }?;
        damper.set_clearance_m(clearance_m);
        Ok(())
    };
    DashpotError::from(done())
}

/// Makes a state at rest, centred in the clearance, without force or status.
///
/// @param state           storage, its content does not matter
/// @param damper          made by `dashpot_damper_init`
/// @param displacement_m  displacement (m), finite
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_init(
    state: *mut DashpotState,
    damper: *const DashpotDamper,
    displacement_m: f32,
) -> DashpotError {
    let done = || {
        check(state)?;
        // SAFETY: the caller's promise.
        let damper = unsafe { made(damper) }?;
        if !displacement_m.is_finite() {
            return Err(DashpotError::Range);
        }
        // SAFETY: checked, and the caller's promise; the storage is a DamperState's to the byte.
        unsafe {
            state
                .cast::<DamperState<f32>>()
                .write(damper.at_rest(displacement_m))
        };
        Ok(())
    };
    DashpotError::from(done())
}

/// Steps one damper: the force at this tick for the displacement of this tick.
///
/// A displacement that is NaN, infinite or faster than the damper allows is no error: it is held or
/// limited, latched in the status and counted. The force is finite and within the force limit.
///
/// @param damper          made by `dashpot_damper_init`
/// @param state           made by `dashpot_state_init` or `dashpot_state_restore`, changed
/// @param displacement_m  displacement (m), positive in extension
/// @param force_n         written: force (N), positive when it resists extension
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_step(
    damper: *const DashpotDamper,
    state: *mut DashpotState,
    displacement_m: f32,
    force_n: *mut f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise.
        let damper = unsafe { made(damper) }?;
        check(force_n)?;
        // SAFETY: the caller's promise; the storage is a DamperState's to the byte.
        let state: &mut DamperState<f32> = unsafe { exclusive(state.cast()) }?;
        let force = damper.step(state, displacement_m);
        // SAFETY: checked, and the caller's promise.
        unsafe { force_n.write(force) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Steps several dampers: the same bits as `dashpot_step` for each, or an error and no step at all.
///
/// @param dampers          `count` pointers to dampers; one damper may serve several states
/// @param states           `count` states, changed
/// @param displacements_m  `count` displacements (m)
/// @param forces_n         written: `count` forces (N); may be the array of displacements
/// @param count            number of dampers, may be 0
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_step_bank(
    dampers: *const *const DashpotDamper,
    states: *mut DashpotState,
    displacements_m: *const f32,
    forces_n: *mut f32,
    count: usize,
) -> DashpotError {
    let done = || {
        check(dampers)?;
        check(states)?;
        check(displacements_m)?;
        check(forces_n)?;
        check_count::<DashpotState>(count)?;
        for index in 0..count {
            // SAFETY: within the caller's array; the caller's promise.
            unsafe { made(*dampers.add(index)) }?;
        }
        for index in 0..count {
            // SAFETY: within the caller's arrays, checked, and the caller's promise. Each element is
            // read before its force is written, so displacements and forces may be one array.
            unsafe {
                let damper = made(*dampers.add(index))?;
                let state: &mut DamperState<f32> = exclusive(states.add(index).cast())?;
                let force = damper.step(state, displacements_m.add(index).read());
                forces_n.add(index).write(force);
            }
        }
        Ok(())
    };
    DashpotError::from(done())
}

/// Reads displacement, force, status bits and the count of rejected inputs.
///
/// @param state    made by `dashpot_state_init` or `dashpot_state_restore`
/// @param reading  written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_read(
    state: *const DashpotState,
    reading: *mut DashpotReading,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise; the storage is a DamperState's to the byte.
        let state: &DamperState<f32> = unsafe { shared(state.cast()) }?;
        check(reading)?;
        let read = DashpotReading {
            displacement_m: state.displacement(),
            force_n: state.force(),
            status: state.status().bits(),
            rejected_inputs: state.rejected_inputs(),
        };
        // SAFETY: checked, and the caller's promise.
        unsafe { reading.write(read) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Clears the status bits and the count of rejected inputs.
///
/// @param state  made by `dashpot_state_init` or `dashpot_state_restore`, changed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_clear_status(state: *mut DashpotState) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise; the storage is a DamperState's to the byte.
        let state: &mut DamperState<f32> = unsafe { exclusive(state.cast()) }?;
        state.clear_status();
        Ok(())
    };
    DashpotError::from(done())
}

/// Saves a state as bytes, for a file or a link; to keep it in memory, copy the structure.
///
/// @param state   made by `dashpot_state_init` or `dashpot_state_restore`
/// @param saved   written, at any alignment
/// @param length  bytes at `saved`, `DASHPOT_SAVED_STATE_SIZE`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_state_save(
    state: *const DashpotState,
    saved: *mut u8,
    length: usize,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller's promise; the storage is a DamperState's to the byte.
        let state: &DamperState<f32> = unsafe { shared(state.cast()) }?;
        check(saved)?;
        if length != saved::BYTES {
            return Err(DashpotError::Length);
        }
        // SAFETY: checked, and the caller's promise; an array of bytes has no alignment.
        unsafe { saved.cast::<[u8; saved::BYTES]>().write(saved::save(state)) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Restores a saved state: its next steps have the bits they would have had.
///
/// @param state   storage, its content does not matter
/// @param damper  the one that stepped the state last
/// @param saved   what `dashpot_state_save` wrote, at any alignment
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
        // SAFETY: the caller's promise.
        let (damper, saved) = unsafe { (made(damper)?, bytes(saved, length)?) };
        let restored = saved::restore(damper, saved)?;
        // SAFETY: checked, and the caller's promise; the storage is a DamperState's to the byte.
        unsafe { state.cast::<DamperState<f32>>().write(restored) };
        Ok(())
    };
    DashpotError::from(done())
}
