//! Functions of the motion filter.

use dashpot_core::hybrid::MotionFilter;

use super::types::{DashpotMotion, DashpotMotionFilter};
use crate::error::DashpotError;
use crate::pointer::{Memory, check, exclusive};

/// Distinguishes a filter from memory that was never written.
const MARK: u32 = 0x5be1_0d36;

/// What the storage contains; any bytes are valid.
#[repr(C)]
struct Stored {
    mark: u32,
    filter: MotionFilter,
}

const _: () = {
    assert!(size_of::<Stored>() == size_of::<DashpotMotionFilter>());
    assert!(align_of::<Stored>() == align_of::<DashpotMotionFilter>());
};

/// Returns an initialised filter for writing.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
unsafe fn made<'a>(filter: *mut DashpotMotionFilter) -> Result<&'a mut MotionFilter, DashpotError> {
    // SAFETY: the caller keeps the contract; the storage has the layout of `Stored`, for which any bytes are valid.
    let stored: &mut Stored = unsafe { exclusive(filter.cast()) }?;
    match stored.mark == MARK {
        true => Ok(&mut stored.filter),
        false => Err(DashpotError::NoTransfer),
    }
}

/// Initialises a motion filter at rest at 0. It estimates velocity, acceleration and jerk of a displacement that is
/// known only at the ticks.
///
/// @param filter   storage with any content; written
/// @param pole_hz  pole of the filter (Hz), 1 to a quarter of the rate of the ticks
/// @param step_s   period of the ticks (s), 1e-5 to 0.02
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_motion_filter_init(
    filter: *mut DashpotMotionFilter,
    pole_hz: f32,
    step_s: f32,
) -> DashpotError {
    let done = || {
        check(filter)?;
        let stored = Stored {
            mark: MARK,
            filter: MotionFilter::new(pole_hz, step_s)?,
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract; the storage has the layout of `Stored`.
        unsafe { filter.cast::<Stored>().write(stored) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Puts a filter at rest at a displacement: at the start, and after a displacement that was not finite.
///
/// @param filter          initialised by `dashpot_motion_filter_init`, changed
/// @param displacement_m  displacement (m), finite
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_motion_filter_rest_at(
    filter: *mut DashpotMotionFilter,
    displacement_m: f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let filter = unsafe { made(filter) }?;
        if !displacement_m.is_finite() {
            return Err(DashpotError::Range);
        }
        filter.rest_at(displacement_m);
        Ok(())
    };
    DashpotError::from(done())
}

/// Takes the displacement of a tick and computes its motion, which `dashpot_transfer_tick` takes.
///
/// A displacement that is not finite makes this motion and those after it useless, until
/// `dashpot_motion_filter_rest_at`; the guard ends the test for the first of them.
///
/// @param filter          initialised by `dashpot_motion_filter_init`, changed
/// @param displacement_m  desired displacement (m)
/// @param motion          written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_motion_filter_push(
    filter: *mut DashpotMotionFilter,
    displacement_m: f32,
    motion: *mut DashpotMotion,
) -> DashpotError {
    let done = || {
        check(motion)?;
        check(filter)?;
        Memory::of(motion).check_apart(Memory::of(filter))?;
        // SAFETY: the caller keeps the contract.
        let estimated = unsafe { made(filter) }?.push(displacement_m);
        let estimated = DashpotMotion {
            displacement_m: estimated.displacement_m,
            velocity_m_per_s: estimated.velocity_m_per_s,
            acceleration_m_per_s2: estimated.acceleration_m_per_s2,
            jerk_m_per_s3: estimated.jerk_m_per_s3,
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { motion.write(estimated) };
        Ok(())
    };
    DashpotError::from(done())
}
