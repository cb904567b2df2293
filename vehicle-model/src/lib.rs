//! A vehicle whose dampers outside other FMUs are, as the model behind `model.h` (`export/src/fmu/sources`).
//!
//! What the C of an FMU promises in every function: a pointer to a model is of `model_new`, and not freed; other pointers are to one value of
//! their type, or to as many bytes as the length says; no model is used by two threads at once. No panic leaves a function.

mod model;
mod result;

use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use model::Model;
use result::ModelResult;

unsafe extern "C" {
    /// Digest of the case that the FMU was exported with.
    static model_case_digest: c_char;
}

/// What a call does with a model that no panic leaves; after one it has failed, and `or` is the answer.
fn guarded<T>(this: &mut Model, or: T, act: impl FnOnce(&mut Model) -> T) -> T {
    catch_unwind(AssertUnwindSafe(|| act(this))).unwrap_or_else(|_| {
        this.fail(FAULT);
        or
    })
}

const FAULT: &str = "a fault of the program";

/// A model of the files in the folder `resources`; null with a reason where they make none.
///
/// # Safety
/// As above; `resources` ends in a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_new(
    resources: *const c_char,
    reason: *mut c_char,
    reason_bytes: usize,
) -> *mut Model {
    let made = catch_unwind(|| {
        if resources.is_null() {
            return Err("no folder of resources".into());
        }
        // SAFETY: not null, ends in a zero.
        let folder = unsafe { CStr::from_ptr(resources) };
        let folder = folder
            .to_str()
            .map_err(|error| format!("the folder of resources: {error}"))?;
        // SAFETY: a constant of the FMU that ends in a zero.
        let digest = unsafe { CStr::from_ptr(&raw const model_case_digest) };
        Model::new(Path::new(folder), &digest.to_string_lossy())
    });
    match made.unwrap_or_else(|_| Err(FAULT.into())) {
        Ok(model) => Box::into_raw(Box::new(model)),
        Err(text) => {
            // SAFETY: as many bytes as the length says.
            unsafe { put_text(&text, reason, reason_bytes) };
            std::ptr::null_mut()
        }
    }
}

/// Frees it; nothing of a null pointer.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_free(this: *mut Model) {
    if !this.is_null() {
        // SAFETY: of `model_new`.
        drop(unsafe { Box::from_raw(this) });
    }
}

/// Start values again.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_reset(this: &mut Model) {
    guarded(this, (), Model::reset);
}

/// A number.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_get_real(
    this: &mut Model,
    variable: u32,
    value: *mut f64,
) -> ModelResult {
    match guarded(this, None, |this| this.number(variable)) {
        Some(number) => {
            // SAFETY: to one value.
            unsafe { value.write(number) };
            ModelResult::Done
        }
        None => ModelResult::NoVariable,
    }
}

/// Whether it may be set.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_check_real(this: &Model, variable: u32, value: f64) -> ModelResult {
    this.check(variable, value)
}

/// Sets what may be set.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_set_real(this: &mut Model, variable: u32, value: f64) {
    guarded(this, (), |this| this.set(variable, value));
}

/// No input is interpolated.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_set_derivative(_: &mut Model, _: u32, _: f64) -> ModelResult {
    ModelResult::NoVariable
}

/// How it ended.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_get_integer(
    this: &Model,
    variable: u32,
    value: *mut i32,
) -> ModelResult {
    match this.integer(variable) {
        Some(integer) => {
            // SAFETY: to one value.
            unsafe { value.write(integer) };
            ModelResult::Done
        }
        None => ModelResult::NoVariable,
    }
}

/// What is allowed for a variable, in words.
#[unsafe(no_mangle)]
pub extern "C" fn model_allowed(_: u32) -> *const c_char {
    c"a force that is a finite number".as_ptr()
}

/// The vehicle stands as the case has it.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_start(_: &mut Model) {}

/// Ticks, fewer where it ends: how many.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_step(this: &mut Model, steps: u64) -> u64 {
    guarded(this, 0, |this| this.step(steps))
}

/// Whether it has ended.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_has_ended(this: &Model) -> bool {
    this.has_ended()
}

/// Whether it has failed.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_has_failed(this: &Model) -> bool {
    this.has_failed()
}

/// What happened since it was last asked; null where nothing did.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_notice(this: &mut Model) -> *const c_char {
    this.notice().map_or(std::ptr::null(), CStr::as_ptr)
}

/// Bytes of a state.
///
/// # Safety
/// As above.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_saved_bytes(this: &Model) -> usize {
    this.saved_bytes()
}

/// All that changes.
///
/// # Safety
/// As above; `bytes` has as many as [`model_saved_bytes`] says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_save(this: &mut Model, bytes: *mut u8) {
    let count = this.saved_bytes();
    // SAFETY: as many as the caller promises, written before they are read, and nobody else's.
    let bytes = unsafe {
        bytes.write_bytes(0, count);
        std::slice::from_raw_parts_mut(bytes, count)
    };
    guarded(this, (), |this| this.save(bytes));
}

/// Goes on from a state; refused, the model stays as it is.
///
/// # Safety
/// As above; `bytes` has as many as [`model_saved_bytes`] says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn model_restore(this: &mut Model, bytes: *const u8) -> ModelResult {
    // SAFETY: as many as the caller promises.
    let bytes = unsafe { std::slice::from_raw_parts(bytes, this.saved_bytes()) };
    guarded(this, ModelResult::Other, |this| this.restore(bytes))
}

/// As much of a text as there is room for, and a zero.
///
/// # Safety
/// `to` has room for `bytes`.
unsafe fn put_text(text: &str, to: *mut c_char, bytes: usize) {
    if to.is_null() || bytes == 0 {
        return;
    }
    let text = &text.as_bytes()[..text.floor_char_boundary(bytes - 1)];
    for (place, byte) in text.iter().chain(&[0]).enumerate() {
        // SAFETY: less than `bytes`.
        unsafe { to.add(place).write(*byte as c_char) };
    }
}
