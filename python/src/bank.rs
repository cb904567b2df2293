//! Steps several dampers in one call, which takes less time than stepping them one by one and gives the same bits.

use dashpot_core::{Damper as Constants, DamperState};
use dashpot_testbench::motion::follow_bank;
use numpy::{Ix1, Ix2, PyArray2, PyArrayDescr, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyList;

use crate::arrays::{self, Precision};
use crate::built::{BuiltDamper, Scalar};
use crate::error::{Outcome, refuse};
use crate::interruption::Interruption;
use crate::pickled::{Pickled, pickled};
use crate::state::State;

/// Built dampers with the same step and precision, stepped together; the same damper may occur several times.
///
/// >>> import dashpot, numpy
/// >>> built = [dashpot.Damper(name).build(1e-3) for name in ("paper", "in-service")]
/// >>> bank = dashpot.Bank(built)
/// >>> x = numpy.zeros((1000, 2), numpy.float32)
/// >>> x[:] = 5e-3 * numpy.sin(numpy.arange(1000) / 160)[:, None]
/// >>> force_n = bank.replay(x)
/// >>> bool(numpy.all(force_n[:, 1] == built[1].replay(x[:, 1].copy())))
/// True
#[pyclass(module = "dashpot", frozen)]
pub struct Bank {
    dampers: Vec<Py<BuiltDamper>>,
    precision: Precision,
}

impl Bank {
    fn replay_in<'py, T: Scalar>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
        states: Option<&[Bound<'py, State>]>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Outcome<Bound<'py, PyAny>> {
        let count = self.dampers.len();
        let motion = arrays::read::<T, Ix2>("x", x)?;
        let [ticks, columns] = [motion.shape()[0], motion.shape()[1]];
        if columns != count {
            return refuse(format!(
                "x: {columns} columns, allowed: one for each damper, {count}"
            ));
        }
        let displacements = motion.as_slice().map_err(PyErr::from)?;
        let forces = match out {
            Some(out) => out.clone(),
            None => PyArray2::<T>::zeros(py, [ticks, count], false).into_any(),
        };
        let mut written = arrays::write::<T, Ix2>("out", &forces, &motion)?;
        if written.shape() != motion.shape() {
            return refuse(format!(
                "out: shape {:?}, allowed: that of x, {:?}",
                written.shape(),
                motion.shape()
            ));
        }
        let into = written.as_slice_mut().map_err(PyErr::from)?;
        let constants = self
            .dampers
            .iter()
            .filter_map(|damper| T::constants(&damper.get().kept));
        let constants: Vec<&Constants<T>> = constants.collect();
        let mut kept = match states {
            Some(states) => Some(self.lend(states)?),
            None => None,
        };
        let mut at: Vec<DamperState<T>> = match &mut kept {
            Some(kept) => {
                let states = kept
                    .iter_mut()
                    .filter_map(|state| T::state(&mut state.numbers));
                states.map(|state| *state).collect()
            }
            None => {
                let first = displacements
                    .iter()
                    .copied()
                    .chain(std::iter::repeat(T::ZERO));
                let at_rest = constants.iter().zip(first).map(|(one, x)| one.at_rest(x));
                at_rest.collect()
            }
        };
        if at.len() != count {
            let dtype = self.precision.dtype(py);
            return refuse(format!(
                "states: wrong precision, allowed: states of {dtype}, the precision of the dampers"
            ));
        }
        let interruption = py.detach(|| {
            let interruption = Interruption::default();
            follow_bank(&constants, &mut at, displacements, into, &|| {
                interruption.is_requested()
            });
            interruption.raised()
        });
        // An interrupted motion leaves the states unchanged.
        interruption?;
        if ticks > 0 {
            let kept = kept.into_iter().flatten();
            for ((mut state, at), damper) in kept.zip(at).zip(&self.dampers) {
                state.numbers = T::numbers(at);
                state.stepped_by(damper.bind(py).as_any());
            }
        }
        Ok(forces)
    }

    /// The dampers as a list.
    fn in_python<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.dampers.iter().map(|damper| damper.bind(py)))
    }

    /// Borrows the states for this call.
    fn lend<'py>(&self, states: &[Bound<'py, State>]) -> Outcome<Vec<PyRefMut<'py, State>>> {
        if states.len() != self.dampers.len() {
            return refuse(format!(
                "states: {}, allowed: one for each damper, {}",
                states.len(),
                self.dampers.len()
            ));
        }
        states.iter().map(State::lend).collect()
    }
}

#[pymethods]
impl Bank {
    #[new]
    fn new(dampers: Vec<Bound<'_, BuiltDamper>>) -> Outcome<Self> {
        let Some(first) = dampers.first().map(Bound::get) else {
            return refuse("dampers: none, allowed: at least one");
        };
        for (number, other) in dampers.iter().map(Bound::get).enumerate() {
            if other.precision() != first.precision()
                || other.step_s.to_bits() != first.step_s.to_bits()
            {
                return refuse(format!(
                    "damper {number}: its step or precision differs from that of damper 0, allowed: one step and one \
                     precision"
                ));
            }
        }
        Ok(Self {
            precision: first.precision(),
            dampers: dampers.into_iter().map(Bound::unbind).collect(),
        })
    }

    /// Returns a state at rest for each damper. `displacements_m` gives the displacement (m) of each, as an array of
    /// this bank's precision; default: 0.
    #[pyo3(signature = (displacements_m=None))]
    fn at_rest(
        &self,
        py: Python<'_>,
        displacements_m: Option<&Bound<'_, PyAny>>,
    ) -> Outcome<Vec<State>> {
        let count = self.dampers.len();
        let displacements: Vec<f64> = match (displacements_m, self.precision) {
            (None, _) => vec![0.0; count],
            (Some(array), Precision::Single) => {
                let array = arrays::read::<f32, Ix1>("displacements_m", array)?;
                array.as_array().iter().copied().map(f64::from).collect()
            }
            (Some(array), Precision::Double) => arrays::read::<f64, Ix1>("displacements_m", array)?
                .as_array()
                .to_vec(),
        };
        if displacements.len() != count {
            return refuse(format!(
                "displacements_m: {} numbers, allowed: one for each damper, {count}",
                displacements.len()
            ));
        }
        let dampers = self.dampers.iter().zip(displacements);
        Ok(dampers
            .map(|(damper, at)| BuiltDamper::at_rest(damper.bind(py), at))
            .collect())
    }

    /// Returns the forces (N) at the displacements (m) of `x`, with one row per tick and one column per damper. Each
    /// column works like `BuiltDamper.replay`.
    #[pyo3(signature = (x, *, states=None, out=None))]
    fn replay<'py>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
        states: Option<Vec<Bound<'py, State>>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Outcome<Bound<'py, PyAny>> {
        match self.precision {
            Precision::Single => self.replay_in::<f32>(py, x, states.as_deref(), out),
            Precision::Double => self.replay_in::<f64>(py, x, states.as_deref(), out),
        }
    }

    /// Step size (s).
    #[getter]
    fn step_s(&self) -> f64 {
        self.dampers
            .first()
            .map_or(f64::NAN, |damper| damper.get().step_s)
    }

    /// The precision of the step: float32 or float64.
    #[getter]
    fn dtype<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDescr> {
        self.precision.dtype(py)
    }

    fn __len__(&self) -> usize {
        self.dampers.len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.in_python(py)?.try_iter()?.into_any())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("Bank({})", self.in_python(py)?.repr()?))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Outcome<Pickled<'py>> {
        let dampers = slf.get().in_python(slf.py())?;
        pickled(slf.get_type().into_any(), (dampers,))
    }
}
