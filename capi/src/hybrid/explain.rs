//! Names the setting for which a transfer system is refused.

use core::ffi::c_char;

use super::any;
use super::types::DashpotTransferSettings;
use crate::error::DashpotError;
use crate::pointer::{Memory, check, check_count, shared};

/// Writes which setting `dashpot_transfer_init` refuses, and what is allowed, like `guard.ramp_s: 0.01 to 10`. The text
/// is empty if all settings are allowed. A text that does not fit is cut. Not for an interrupt.
///
/// @param settings  the settings
/// @param step_s    the step (s)
/// @param text      written: English text with a zero at its end
/// @param length    number of bytes for the text, at least 1; 128 are always enough
#[unsafe(no_mangle)]
pub unsafe extern "C" fn dashpot_transfer_explain(
    settings: *const DashpotTransferSettings,
    step_s: f32,
    text: *mut c_char,
    length: usize,
) -> DashpotError {
    let done = || {
        // SAFETY: the caller keeps the contract; any bytes are valid settings.
        let given = *unsafe { shared(settings) }?;
        check(text)?;
        check_count::<u8>(length)?;
        let Some(room) = length.checked_sub(1) else {
            return Err(DashpotError::Length);
        };
        Memory::array(text, length).check_apart(Memory::of(settings))?;
        let mut written = 0;
        if let Err(error) = any::build(&given, step_s) {
            let parts = [error.section, ".", error.field, ": ", error.allowed];
            for byte in parts.iter().flat_map(|part| part.bytes()).take(room) {
                // SAFETY: the byte is within the caller's array, and the caller keeps the contract.
                unsafe { text.cast::<u8>().add(written).write(byte) };
                written += 1;
            }
        }
        // SAFETY: at most `room` bytes are written, so there is one more.
        unsafe { text.add(written).write(0) };
        Ok(())
    };
    DashpotError::from(done())
}
