//! Functions of the transfer system.

use core::mem::offset_of;

use dashpot_core::hybrid::{HybridStatus, Measured, Motion, TransferSystem};

use super::any::{self, AnyCompensator};
use super::types::{
    DASHPOT_PHASE_APPROACHING, DASHPOT_PHASE_ENDING, DASHPOT_PHASE_HELD, DASHPOT_PHASE_RUNNING,
    DashpotCommand, DashpotMeasured, DashpotMotion, DashpotTransfer, DashpotTransferReading,
    DashpotTransferSettings,
};
use crate::error::DashpotError;
use crate::pointer::{Memory, check, exclusive, shared};

/// Distinguishes a system from memory that was never written.
const MARK: u32 = 0x7d3a_95c1;

/// What the storage contains.
#[repr(C)]
struct Stored {
    mark: u32,
    system: TransferSystem<AnyCompensator>,
}

const _: () = {
    assert!(size_of::<Stored>() <= size_of::<DashpotTransfer>());
    assert!(align_of::<Stored>() <= align_of::<DashpotTransfer>());
    assert!(offset_of!(Stored, mark) == 0);
};

/// Checks that the storage contains a system. Not all bytes are a valid system, so no reference may exist before this.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
unsafe fn check_made(system: *const DashpotTransfer) -> Result<(), DashpotError> {
    check(system)?;
    // SAFETY: the pointer is checked, and the caller keeps the contract; any bytes are a valid number.
    match unsafe { system.cast::<u32>().read() } == MARK {
        true => Ok(()),
        false => Err(DashpotError::NoTransfer),
    }
}

/// Returns an initialised system for writing.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
unsafe fn made<'a>(
    system: *mut DashpotTransfer,
) -> Result<&'a mut TransferSystem<AnyCompensator>, DashpotError> {
    // SAFETY: the caller keeps the contract; storage with the mark was written by `dashpot_transfer_init`.
    unsafe {
        check_made(system)?;
        Ok(&mut exclusive::<Stored>(system.cast())?.system)
    }
}

/// Initialises a transfer system at rest at 0.
///
/// Do not call it within a tick. It needs twice the size of the system as stack. `dashpot_transfer_explain`
/// names the setting if it returns `DASHPOT_ERROR_RANGE`. A flipped bit in the storage is not detected.
///
/// @param system    storage with any content; written
/// @param settings  from `dashpot_transfer_settings_init`, changed as needed; not needed afterwards
/// @param step_s    period of the ticks (s), 1e-5 to 0.02
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_init(
    system: *mut DashpotTransfer,
    settings: *const DashpotTransferSettings,
    step_s: f32,
) -> DashpotError {
    let done = || {
        check(system)?;
        // SAFETY: the caller keeps the contract; any bytes are valid settings.
        let given: &DashpotTransferSettings = unsafe { shared(settings) }?;
        Memory::of(system).check_apart(Memory::of(settings))?;
        let made = any::build(given, step_s).map_err(|_| DashpotError::Range)?;
        let stored = Stored {
            mark: MARK,
            system: made,
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract; there is room for `Stored`.
        unsafe { system.cast::<Stored>().write(stored) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Takes the desired motion and the measured values of a tick; computes the command and the force for the vehicle.
///
/// A number that is NaN, too large or too old is not an error: it is left out, latched in the status, and ends the test
/// if the guard says so. The command never moves by more than the velocity limit times the step, and all results are
/// finite.
///
/// @param system    initialised by `dashpot_transfer_init`, changed
/// @param desired   desired motion
/// @param measured  measured values, or NULL if none came
/// @param command   written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_tick(
    system: *mut DashpotTransfer,
    desired: *const DashpotMotion,
    measured: *const DashpotMeasured,
    command: *mut DashpotCommand,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        unsafe { check_made(system) }?;
        // SAFETY: the caller keeps the contract; any bytes are a valid motion.
        let given: DashpotMotion = *unsafe { shared(desired) }?;
        check(command)?;
        let (written, moving) = (Memory::of(command), Memory::of(system));
        written.check_apart(moving)?;
        written.check_apart(Memory::of(desired))?;
        moving.check_apart(Memory::of(desired))?;
        let measured = if measured.is_null() {
            None
        } else {
            // SAFETY: the caller keeps the contract; any bytes are valid measured values.
            let values: DashpotMeasured = *unsafe { shared(measured) }?;
            written.check_apart(Memory::of(measured))?;
            moving.check_apart(Memory::of(measured))?;
            Some(Measured {
                displacement_m: values.displacement_m,
                force_n: values.force_n,
            })
        };
        // SAFETY: the caller keeps the contract.
        let system = unsafe { made(system) }?;
        let desired = Motion {
            displacement_m: given.displacement_m,
            velocity_m_per_s: given.velocity_m_per_s,
            acceleration_m_per_s2: given.acceleration_m_per_s2,
            jerk_m_per_s3: given.jerk_m_per_s3,
        };
        let computed = system.tick(&desired, measured);
        let result = DashpotCommand {
            command_m: computed.command_m,
            force_n: computed.force_n,
            status: computed.status.bits(),
            phase: phase(system),
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { command.write(result) };
        Ok(())
    };
    DashpotError::from(done())
}

fn phase(system: &mut TransferSystem<AnyCompensator>) -> u16 {
    let guard = system.guard();
    match (guard.is_running(), guard.has_ended(), guard.is_held()) {
        (true, ..) => DASHPOT_PHASE_RUNNING,
        (_, false, _) => DASHPOT_PHASE_APPROACHING,
        (.., false) => DASHPOT_PHASE_ENDING,
        (.., true) => DASHPOT_PHASE_HELD,
    }
}

/// Places a system that has not ended a test at the actuator's present displacement, from which the command approaches
/// the desired one. After the end of a test it changes nothing.
///
/// @param system          initialised by `dashpot_transfer_init`, changed
/// @param displacement_m  displacement (m); one beyond the stroke counts as the stroke
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_place(
    system: *mut DashpotTransfer,
    displacement_m: f32,
) -> DashpotError {
    let done = || {
        if !displacement_m.is_finite() {
            return Err(DashpotError::Range);
        }
        // SAFETY: the caller keeps the contract.
        unsafe { made(system) }?.place(displacement_m);
        Ok(())
    };
    DashpotError::from(done())
}

/// Ends the test: the command comes to rest, and `DASHPOT_HYBRID_REQUESTED` is latched.
///
/// @param system  initialised by `dashpot_transfer_init`, changed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_end(system: *mut DashpotTransfer) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let guard = unsafe { made(system) }?.guard();
        guard.end(HybridStatus::REQUESTED);
        Ok(())
    };
    DashpotError::from(done())
}

/// Clears the status. A test that has come to rest starts again: the command approaches the desired displacement. While
/// the command is still coming to rest, nothing is cleared and the result is `DASHPOT_ERROR_MOVING`.
///
/// @param system  initialised by `dashpot_transfer_init`, changed
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_clear(system: *mut DashpotTransfer) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        match unsafe { made(system) }?.guard().clear() {
            true => Ok(()),
            false => Err(DashpotError::Moving),
        }
    };
    DashpotError::from(done())
}

/// Reads tracking, energy and coefficients. It needs square roots and an arc tangent, so do not call it in every tick.
///
/// @param system   initialised by `dashpot_transfer_init`
/// @param reading  written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_read(
    system: *const DashpotTransfer,
    reading: *mut DashpotTransferReading,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; storage with the mark was written by `dashpot_transfer_init`.
        let system = unsafe {
            check_made(system)?;
            check(reading)?;
            Memory::of(reading).check_apart(Memory::of(system))?;
            &shared::<Stored>(system.cast())?.system
        };
        let tracking = system.tracking();
        let (coefficients, is_frozen) = system.compensator().coefficients();
        let read = DashpotTransferReading {
            delay_s: tracking.delay_s,
            amplitude: tracking.amplitude,
            relative_error: tracking.relative_error,
            error_m: tracking.error_m,
            added_j: system.energy().added_j(),
            added_share: system.energy().added_share(),
            coefficients,
            is_frozen: u32::from(is_frozen),
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { reading.write(read) };
        Ok(())
    };
    DashpotError::from(done())
}
