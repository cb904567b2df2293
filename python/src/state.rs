//! State of a damper, which changes from tick to tick.

use dashpot_core::{DamperState, Real};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyType};

use crate::error::{Outcome, refuse};
use crate::pickled::{Pickled, pickled};

/// A state in either precision.
#[derive(Clone, Copy, PartialEq)]
pub enum Numbers {
    Single(DamperState<f32>),
    Double(DamperState<f64>),
}

/// Evaluates `$body` with the state in its precision.
macro_rules! in_precision {
    ($numbers:expr, $state:ident => $body:expr) => {
        match $numbers {
            Numbers::Single($state) => $body,
            Numbers::Double($state) => $body,
        }
    };
}

/// State of one damper. `BuiltDamper.at_rest` creates one; `copy.copy` saves it, and `pickle` stores it with its
/// damper.
///
/// >>> import copy, dashpot
/// >>> built = dashpot.Damper("paper").build()
/// >>> state = built.at_rest(0.0)
/// >>> before = copy.copy(state)
/// >>> built.step(state, 1e-4) == built.step(before, 1e-4)
/// True
#[pyclass(module = "dashpot")]
pub struct State {
    pub numbers: Numbers,
    /// The `BuiltDamper` that last stepped the state.
    by: Py<PyAny>,
}

static STATUS: PyOnceLock<Py<PyType>> = PyOnceLock::new();

impl State {
    /// A state of a damper.
    pub fn new(numbers: Numbers, by: &Bound<'_, PyAny>) -> Self {
        let by = by.clone().unbind();
        Self { numbers, by }
    }

    /// Borrows the state for this call.
    pub fn lend<'py>(state: &Bound<'py, Self>) -> Outcome<PyRefMut<'py, Self>> {
        match state.try_borrow_mut() {
            Ok(state) => Ok(state),
            Err(_) => refuse("state: another call is stepping it; use one state per thread"),
        }
    }

    /// Records that a damper has stepped the state.
    pub fn stepped_by(&mut self, damper: &Bound<'_, PyAny>) {
        if !self.by.is(damper) {
            self.by = damper.clone().unbind();
        }
    }

    fn seen<'py>(state: &Bound<'py, Self>) -> Outcome<PyRef<'py, Self>> {
        match state.try_borrow() {
            Ok(state) => Ok(state),
            Err(_) => refuse("state: another call is stepping it; wait until it returns"),
        }
    }
}

#[pymethods]
impl State {
    /// Displacement at the last tick (m), positive in extension.
    #[getter]
    fn displacement_m(slf: &Bound<'_, Self>) -> Outcome<f64> {
        Ok(in_precision!(&Self::seen(slf)?.numbers, state => state.displacement_m().to_f64()))
    }

    /// Piston displacement in the cylinder (m).
    #[getter]
    fn piston_displacement_m(slf: &Bound<'_, Self>) -> Outcome<f64> {
        Ok(
            in_precision!(&Self::seen(slf)?.numbers, state => state.piston_displacement_m().to_f64()),
        )
    }

    /// Force at the last tick (N), positive when it resists extension.
    #[getter]
    fn force_n(slf: &Bound<'_, Self>) -> Outcome<f64> {
        Ok(in_precision!(&Self::seen(slf)?.numbers, state => state.force_n().to_f64()))
    }

    /// Revision of the damper that last stepped the state.
    #[getter]
    fn revision(slf: &Bound<'_, Self>) -> Outcome<u32> {
        Ok(in_precision!(&Self::seen(slf)?.numbers, state => state.revision()))
    }

    /// Number of ticks whose displacement was held or limited; it stops at 65535.
    #[getter]
    fn rejected_inputs(slf: &Bound<'_, Self>) -> Outcome<u16> {
        Ok(in_precision!(&Self::seen(slf)?.numbers, state => state.rejected_inputs()))
    }

    /// Status bits latched since they were last cleared, as a `dashpot.Status`.
    #[getter]
    fn status<'py>(slf: &Bound<'py, Self>) -> Outcome<Bound<'py, PyAny>> {
        let bits = in_precision!(&Self::seen(slf)?.numbers, state => state.status().bits());
        let status = STATUS.import(slf.py(), "dashpot._status", "Status")?;
        Ok(status.call1((bits,))?)
    }

    /// Clears the status bits and the counter.
    fn clear_status(slf: &Bound<'_, Self>) -> Outcome<()> {
        in_precision!(&mut Self::lend(slf)?.numbers, state => state.clear_status());
        Ok(())
    }

    /// The state as self-contained bytes, the same in C and in Rust; `BuiltDamper.state_from_bytes` restores it.
    ///
    /// >>> import dashpot
    /// >>> built = dashpot.Damper("paper").build()
    /// >>> built.state_from_bytes(built.at_rest(0.25).to_bytes()).displacement_m
    /// 0.25
    fn to_bytes<'py>(slf: &Bound<'py, Self>) -> Outcome<Bound<'py, PyBytes>> {
        let state = Self::seen(slf)?;
        Ok(in_precision!(&state.numbers, state => PyBytes::new(slf.py(), &state.save())))
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> Outcome<bool> {
        let Ok(other) = other.cast::<Self>() else {
            return Ok(false);
        };
        Ok(Self::seen(slf)?.numbers == Self::seen(other)?.numbers)
    }

    fn __copy__(slf: &Bound<'_, Self>) -> Outcome<Self> {
        let state = Self::seen(slf)?;
        Ok(Self {
            numbers: state.numbers,
            by: state.by.clone_ref(slf.py()),
        })
    }

    fn __deepcopy__(slf: &Bound<'_, Self>, _memo: &Bound<'_, PyAny>) -> Outcome<Self> {
        Self::__copy__(slf)
    }

    fn __repr__(slf: &Bound<'_, Self>) -> Outcome<String> {
        Ok(format!(
            "State(displacement_m={}, force_n={})",
            Self::displacement_m(slf)?,
            Self::force_n(slf)?
        ))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Outcome<Pickled<'py>> {
        let make = Self::seen(slf)?
            .by
            .bind(slf.py())
            .getattr("state_from_bytes")?;
        pickled(make, (Self::to_bytes(slf)?,))
    }
}
