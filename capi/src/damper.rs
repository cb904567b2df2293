//! Functions on a damper.

use dashpot_core::{ClearanceError, Damper};

use crate::error::DashpotError;
use crate::pointer::{Memory, bytes, check, exclusive, shared};
use crate::types::{DashpotDamper, DashpotDamperInfo};

/// Returns an initialised damper.
///
/// # Safety
/// The caller must keep the contract in the documentation of this crate.
pub(crate) unsafe fn made<'a>(
    damper: *const DashpotDamper,
) -> Result<&'a Damper<f32>, DashpotError> {
    // SAFETY: the caller keeps the contract; the storage has the layout of `Damper`, for which any bytes are valid.
    let damper: &Damper<f32> = unsafe { shared(damper.cast()) }?;
    if damper.revision() == 0 {
        Err(DashpotError::NoDamper)
    } else {
        Ok(damper)
    }
}

/// Initialises a damper from an image, the bytes from `dashpot export --lang c` or `--lang bin`.
///
/// The whole image is checked first and is not needed afterwards. The next step adopts states of the old damper and
/// keeps their force. Do not call it within a tick: it takes about 367 000 instructions on a Cortex-M7.
///
/// @param damper  storage with any content; written
/// @param image   the bytes, at any alignment, outside the storage of the damper
/// @param length  number of bytes, `DASHPOT_IMAGE_SIZE`
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_damper_init(
    damper: *mut DashpotDamper,
    image: *const u8,
    length: usize,
) -> DashpotError {
    let done = || {
        check(damper)?;
        // SAFETY: the caller keeps the contract.
        let image = unsafe { bytes(image, length) }?;
        Memory::of(damper).check_apart(Memory::of_bytes(image))?;
        let mut loading = Damper::<f32>::check_image(image)?;
        // SAFETY: the pointer is checked, and the caller keeps the contract; zeros are a valid `Damper`, so a reference
        // to them is allowed.
        let damper: &mut Damper<f32> = unsafe {
            damper.write_bytes(0, 1);
            exclusive(damper.cast())
        }?;
        while !damper.load_slice(image, &mut loading)? {}
        Ok(())
    };
    DashpotError::from(done())
}

/// Reads the properties of a damper. Compare `step_s` with your tick.
///
/// @param damper  initialised by `dashpot_damper_init`
/// @param info    written
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_damper_describe(
    damper: *const DashpotDamper,
    info: *mut DashpotDamperInfo,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract.
        let damper = unsafe { made(damper) }?;
        check(info)?;
        Memory::of(info).check_apart(Memory::of(damper))?;
        let read = DashpotDamperInfo {
            step_s: damper.step_s(),
            clearance_m: damper.clearance_m(),
            force_limit_n: damper.force_limit_n(),
            revision: damper.revision(),
        };
        // SAFETY: the pointer is checked, and the caller keeps the contract.
        unsafe { info.write(read) };
        Ok(())
    };
    DashpotError::from(done())
}

/// Sets the clearance of a damper in use. The next step of each state adopts it and keeps its force.
///
/// On a Cortex-M7 this takes about 324 instructions, and the next step of each state then takes about 1540 instructions
/// instead of the usual number.
///
/// @param damper       initialised by `dashpot_damper_init`; no step may use it during the call
/// @param clearance_m  clearance 2a, the total play (m), 0 to 0.1
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_damper_set_clearance(
    damper: *mut DashpotDamper,
    clearance_m: f32,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; the reference ends with this statement.
        unsafe { made(damper) }?;
        // SAFETY: the caller keeps the contract; the storage has the layout of `Damper`.
        let damper: &mut Damper<f32> = unsafe { exclusive(damper.cast()) }?;
        let set = damper.set_clearance_m(clearance_m);
        set.map_err(|_: ClearanceError| DashpotError::Range)
    };
    DashpotError::from(done())
}
