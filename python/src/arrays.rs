//! Borrowed numpy arrays: one element type, contiguous, aligned, never copied.

use std::ops::Range;

use numpy::{
    Element, PyArray, PyArrayDescr, PyArrayDescrMethods, PyArrayMethods, PyReadonlyArray,
    PyReadwriteArray, PyUntypedArray, PyUntypedArrayMethods, dtype,
};
use pyo3::prelude::*;

use crate::error::{Outcome, refuse};

/// Borrows a Python array for reading; errors call the array `name`.
pub fn read<'py, T: Element, D: numpy::ndarray::Dimension>(
    name: &str,
    array: &Bound<'py, PyAny>,
) -> Outcome<PyReadonlyArray<'py, T, D>> {
    match usable::<T, D>(name, array, false)?.try_readonly() {
        Ok(array) => Ok(array),
        Err(_) => refuse(format!("{name}: another call is writing to it")),
    }
}

/// Borrows a Python array for writing while `input` is borrowed for reading; errors call the array `name`.
pub fn write<'py, T: Element, D: numpy::ndarray::Dimension>(
    name: &str,
    array: &Bound<'py, PyAny>,
    input: &PyReadonlyArray<'py, T, D>,
) -> Outcome<PyReadwriteArray<'py, T, D>> {
    let array = usable::<T, D>(name, array, true)?;
    // numpy's borrow checker distinguishes views of one array, but not arrays that two libraries built on the same
    // memory.
    let [to, from] = [memory(array), memory(input)];
    let is_shared = to.start < from.end && from.start < to.end;
    match array.try_readwrite() {
        Ok(array) if !is_shared => Ok(array),
        _ => refuse(format!(
            "{name}: it shares memory with an input array or with an array that another call uses; allowed: separate \
             memory"
        )),
    }
}

/// Address range of a contiguous array.
fn memory<T: Element, D: numpy::ndarray::Dimension>(
    array: &Bound<'_, PyArray<T, D>>,
) -> Range<usize> {
    let start = array.data().addr();
    start..start + array.len() * size_of::<T>()
}

/// Returns the array if it can be borrowed without copying.
fn usable<'a, 'py, T: Element, D: numpy::ndarray::Dimension>(
    name: &str,
    array: &'a Bound<'py, PyAny>,
    is_written: bool,
) -> Outcome<&'a Bound<'py, PyArray<T, D>>> {
    let py = array.py();
    let expected = dtype::<T>(py);
    let dimensions = D::NDIM.unwrap_or(1);
    let allowed = format!(
        "a numpy array of {expected} with {dimensions} dimension{}",
        if dimensions == 1 { "" } else { "s" }
    );
    let Ok(untyped) = array.cast::<PyUntypedArray>() else {
        let found = array.get_type().name()?;
        let one = match is_written {
            true => String::new(),
            false => format!("; use numpy.asarray({name}, numpy.{expected})"),
        };
        return refuse(format!("{name}: {found}, allowed: {allowed}{one}"));
    };
    let masked = py.import("numpy.ma")?.getattr("MaskedArray")?;
    if array.is_instance(&masked)? {
        return refuse(format!(
            "{name}: a masked array, allowed: {allowed}; use {name}.filled(numpy.nan); at NaN the step holds its \
             last displacement"
        ));
    }
    let found = untyped.dtype();
    if !found.is_equiv_to(&expected) {
        let one = match is_written {
            true => "numpy.empty_like(x)".to_owned(),
            false => format!("{name}.astype(numpy.{expected})"),
        };
        return refuse(format!(
            "{name}: array of {found}, allowed: {allowed}; use {one}"
        ));
    }
    if untyped.ndim() != dimensions {
        return refuse(format!(
            "{name}: {} dimensions, allowed: {allowed}",
            untyped.ndim()
        ));
    }
    let flags = array.getattr("flags")?;
    let is = |flag| -> PyResult<bool> { flags.getattr(flag)?.extract() };
    if !is("c_contiguous")? || !is("aligned")? {
        return refuse(format!(
            "{name}: not contiguous and aligned in memory, allowed: a contiguous and aligned array; use \
             numpy.ascontiguousarray({name}) or a copy"
        ));
    }
    if is_written && !is("writeable")? {
        return refuse(format!(
            "{name}: read-only, allowed: an array that can be written to"
        ));
    }
    match array.cast::<PyArray<T, D>>() {
        Ok(array) => Ok(array),
        Err(_) => refuse(format!("{name}: allowed: {allowed}")),
    }
}

/// Floating-point precision of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// `float32`, as on the target.
    Single,
    /// `float64`.
    Double,
}

impl Precision {
    /// Precision of a dtype or an equivalent object; `float32` by default.
    pub fn of(dtype_like: Option<&Bound<'_, PyAny>>) -> Outcome<Self> {
        let Some(dtype_like) = dtype_like else {
            return Ok(Self::Single);
        };
        let py = dtype_like.py();
        let found = PyArrayDescr::new(py, dtype_like)?;
        if found.is_equiv_to(&dtype::<f32>(py)) {
            Ok(Self::Single)
        } else if found.is_equiv_to(&dtype::<f64>(py)) {
            Ok(Self::Double)
        } else {
            refuse(format!("dtype: {found}, allowed: float32 or float64"))
        }
    }

    /// The dtype.
    pub fn dtype(self, py: Python<'_>) -> Bound<'_, PyArrayDescr> {
        match self {
            Self::Single => dtype::<f32>(py),
            Self::Double => dtype::<f64>(py),
        }
    }
}
