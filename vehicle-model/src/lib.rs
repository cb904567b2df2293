//! Implements the interface `model.h` (`export/src/fmu/sources`) for a vehicle with externally computed dampers.
//!
//! The C code of an FMU guarantees the following for every function. A pointer to a model comes from `model_new` and
//! has not been freed. Other pointers are valid for one value of their type, or for the number of bytes given. No two
//! threads use a model at the same time. In return, no function lets a panic unwind into the C code.

mod model;
mod result;

use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use model::Model;
use result::ModelResult;

unsafe extern "C" {
    /// Null-terminated digest of the case with which the FMU was exported.
    static model_case_digest: c_char;
}

/// Runs `action` on a model and catches panics. After a panic the model has failed, and `fallback` is returned.
fn guarded<T>(this: &mut Model, fallback: T, action: impl FnOnce(&mut Model) -> T) -> T {
    catch_unwind(AssertUnwindSafe(|| action(this))).unwrap_or_else(|_| {
        this.fail(PANIC);
        fallback
    })
}

const PANIC: &str = "internal error of the model";

/// Creates a model from the files in the folder `resources`; on failure, writes the reason and returns null.
///
/// # Safety
/// See the module documentation; `resources` is null-terminated or null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_new(
    resources: *const c_char,
    reason: *mut c_char,
    reason_bytes: usize,
) -> *mut Model {
    let model = catch_unwind(|| {
        if resources.is_null() {
            return Err("no resources folder".into());
        }
        // SAFETY: `resources` is not null, and it is null-terminated.
        let folder = unsafe { CStr::from_ptr(resources) };
        let folder = folder
            .to_str()
            .map_err(|error| format!("resources folder: {error}"))?;
        // SAFETY: the digest is a null-terminated constant of the FMU.
        let digest = unsafe { CStr::from_ptr(&raw const model_case_digest) };
        Model::new(Path::new(folder), &digest.to_string_lossy())
    });
    match model.unwrap_or_else(|_| Err(PANIC.into())) {
        Ok(model) => Box::into_raw(Box::new(model)),
        Err(text) => {
            // SAFETY: `reason` has room for `reason_bytes`.
            unsafe { put_text(&text, reason, reason_bytes) };
            std::ptr::null_mut()
        }
    }
}

/// Frees a model; ignores a null pointer.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_free(this: *mut Model) {
    if !this.is_null() {
        // SAFETY: the pointer comes from `model_new`.
        drop(unsafe { Box::from_raw(this) });
    }
}

/// Resets the model to its start values.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_reset(this: &mut Model) {
    guarded(this, (), Model::reset);
}

/// Reads a real variable.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_get_real(
    this: &mut Model,
    variable: u32,
    value: *mut f64,
) -> ModelResult {
    match guarded(this, None, |this| this.number(variable)) {
        Some(number) => {
            // SAFETY: `value` points to room for one number.
            unsafe { value.write(number) };
            ModelResult::Done
        }
        None => ModelResult::NoVariable,
    }
}

/// Checks whether a real variable may be set to a value.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_check_real(this: &Model, variable: u32, value: f64) -> ModelResult {
    this.check(variable, value)
}

/// Sets a real variable to a value that [`model_check_real`] accepts.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_set_real(this: &mut Model, variable: u32, value: f64) {
    guarded(this, (), |this| this.set(variable, value));
}

/// Refuses derivatives: inputs are not interpolated.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_set_derivative(_: &mut Model, _: u32, _: f64) -> ModelResult {
    ModelResult::NoVariable
}

/// Reads an integer variable; the only one states how the run ended.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_get_integer(
    this: &Model,
    variable: u32,
    value: *mut i32,
) -> ModelResult {
    match this.integer(variable) {
        Some(integer) => {
            // SAFETY: `value` points to room for one number.
            unsafe { value.write(integer) };
            ModelResult::Done
        }
        None => ModelResult::NoVariable,
    }
}

/// Describes the allowed values of a variable.
#[unsafe(no_mangle)]
pub extern "C" fn model_allowed(_: u32) -> *const c_char {
    c"finite forces, applied forces and moments up to 1e8, speed_m_per_s 1 to 150, friction_factor 0 to 5".as_ptr()
}

/// Ends the initialization; the vehicle is already in the initial state of the case.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_start(_: &mut Model) {}

/// Runs steps and returns their number, which is smaller if the run ends.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_step(this: &mut Model, steps: u64) -> u64 {
    guarded(this, 0, |this| this.step(steps))
}

/// True if the run has ended.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_has_ended(this: &Model) -> bool {
    this.has_ended()
}

/// True if the model has failed.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_has_failed(this: &Model) -> bool {
    this.has_failed()
}

/// Returns the message about the last event since the previous call; null if there was none.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_notice(this: &mut Model) -> *const c_char {
    this.notice().map_or(std::ptr::null(), CStr::as_ptr)
}

/// Size of a saved state in bytes.
///
/// # Safety
/// See the module documentation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_saved_bytes(this: &Model) -> usize {
    this.saved_bytes()
}

/// Saves the state.
///
/// # Safety
/// See the module documentation; `bytes` has the length [`model_saved_bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_save(this: &mut Model, bytes: *mut u8) {
    let count = this.saved_bytes();
    // SAFETY: the caller provides `count` bytes for exclusive use; they are written before they are read.
    let bytes = unsafe {
        bytes.write_bytes(0, count);
        std::slice::from_raw_parts_mut(bytes, count)
    };
    guarded(this, (), |this| this.save(bytes));
}

/// Restores a saved state; on failure the model is unchanged.
///
/// # Safety
/// See the module documentation; `bytes` has the length [`model_saved_bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_restore(this: &mut Model, bytes: *const u8) -> ModelResult {
    // SAFETY: the caller provides this number of bytes.
    let bytes = unsafe { std::slice::from_raw_parts(bytes, this.saved_bytes()) };
    guarded(this, ModelResult::Other, |this| this.restore(bytes))
}

/// Writes a text, truncated to `bytes` bytes including the terminating null byte.
///
/// # Safety
/// `to` has room for `bytes`.
unsafe fn put_text(text: &str, to: *mut c_char, bytes: usize) {
    if to.is_null() || bytes == 0 {
        return;
    }
    let mut end = text.len().min(bytes - 1);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let text = &text.as_bytes()[..end];
    for (index, byte) in text.iter().chain(&[0]).enumerate() {
        // SAFETY: the index is less than `bytes`.
        unsafe { to.add(index).write(*byte as c_char) };
    }
}
