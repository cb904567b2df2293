//! A damper's constants for one step size, and replay of motions.

use dashpot_core::{CheckedParameters, Damper as Constants, DamperState, Real};
use dashpot_files::damper;
use dashpot_testbench::motion::follow;
use numpy::{Element, Ix1, PyArray1, PyArrayDescr};
use pyo3::prelude::*;

use crate::arrays::{self, Precision};
use crate::error::{Outcome, refuse};
use crate::interruption::Interruption;
use crate::pickled::{Pickled, pickled};
use crate::state::{Numbers, State};

/// Constants in either precision.
#[derive(Clone)]
pub enum Kept {
    Single(Box<Constants<f32>>),
    Double(Box<Constants<f64>>),
}

/// A precision with access to its constants and states.
pub trait Scalar: Real + Element {
    fn constants(kept: &Kept) -> Option<&Constants<Self>>;
    fn state(numbers: &mut Numbers) -> Option<&mut DamperState<Self>>;
    fn numbers(state: DamperState<Self>) -> Numbers;
}

macro_rules! scalar {
    ($float:ty, $variant:ident) => {
        impl Scalar for $float {
            fn constants(kept: &Kept) -> Option<&Constants<Self>> {
                match kept {
                    Kept::$variant(constants) => Some(constants),
                    _ => None,
                }
            }

            fn state(numbers: &mut Numbers) -> Option<&mut DamperState<Self>> {
                match numbers {
                    Numbers::$variant(state) => Some(state),
                    _ => None,
                }
            }

            fn numbers(state: DamperState<Self>) -> Numbers {
                Numbers::$variant(state)
            }
        }
    };
}

scalar!(f32, Single);
scalar!(f64, Double);

/// Evaluates `$body` with the constants in their precision.
macro_rules! in_precision {
    ($kept:expr, $constants:ident => $body:expr) => {
        match $kept {
            Kept::Single($constants) => $body,
            Kept::Double($constants) => $body,
        }
    };
}

/// A damper built for a fixed step. It never changes, and any number of states and threads can share it.
/// `Damper.build` creates one.
///
/// >>> import dashpot
/// >>> built = dashpot.Damper("reduced-vertical").build(step_s=1e-3)
/// >>> state = built.at_rest(0.0)
/// >>> for tick in range(1, 1001):
/// ...     force_n = built.step(state, 0.02e-3 * tick)  # 0.02 m/s
/// >>> round(force_n)  # C v
/// 2400
#[pyclass(module = "dashpot", frozen)]
pub struct BuiltDamper {
    pub name: String,
    parameters: CheckedParameters,
    pub step_s: f64,
    pub kept: Kept,
}

impl BuiltDamper {
    /// Builds a damper for a step size.
    pub fn new(
        name: &str,
        parameters: &CheckedParameters,
        step_s: f64,
        precision: Precision,
    ) -> Outcome<Self> {
        let kept = match precision {
            Precision::Single => Kept::Single(Box::new(parameters.build(step_s)?)),
            Precision::Double => Kept::Double(Box::new(parameters.build(step_s)?)),
        };
        Ok(Self {
            name: name.to_owned(),
            parameters: parameters.clone(),
            step_s,
            kept,
        })
    }

    /// Precision of the constants.
    pub fn precision(&self) -> Precision {
        match self.kept {
            Kept::Single(_) => Precision::Single,
            Kept::Double(_) => Precision::Double,
        }
    }

    /// Error for a state whose precision differs from the damper's.
    pub fn other_precision<T>(&self, py: Python<'_>) -> Outcome<T> {
        let here = self.precision().dtype(py);
        refuse(format!(
            "state: wrong precision, allowed: a state of {here}, this damper's precision"
        ))
    }

    fn replay_in<'py, T: Scalar>(
        slf: &Bound<'py, Self>,
        constants: &Constants<T>,
        x: &Bound<'py, PyAny>,
        state: Option<&Bound<'py, State>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Outcome<Bound<'py, PyAny>> {
        let py = slf.py();
        let motion = arrays::read::<T, Ix1>("x", x)?;
        let displacements = motion.as_slice().map_err(PyErr::from)?;
        let forces = match out {
            Some(out) => out.clone(),
            None => PyArray1::<T>::zeros(py, displacements.len(), false).into_any(),
        };
        let mut written = arrays::write::<T, Ix1>("out", &forces, &motion)?;
        let into = written.as_slice_mut().map_err(PyErr::from)?;
        if into.len() != displacements.len() {
            return refuse(format!(
                "out: {} numbers, allowed: as many as x, {}",
                into.len(),
                displacements.len()
            ));
        }
        let mut kept = state.map(State::lend).transpose()?;
        let mut at = match &mut kept {
            Some(state) => match T::state(&mut state.numbers) {
                Some(state) => *state,
                None => return slf.get().other_precision(py),
            },
            None => constants.at_rest(displacements.first().copied().unwrap_or(T::ZERO)),
        };
        let interruption = py.detach(|| {
            let interruption = Interruption::default();
            follow(constants, &mut at, displacements, into, &|| {
                interruption.is_requested()
            });
            interruption.raised()
        });
        // An interrupted motion leaves the state unchanged.
        interruption?;
        if let Some(mut state) = kept
            && !displacements.is_empty()
        {
            state.numbers = T::numbers(at);
            state.stepped_by(slf.as_any());
        }
        Ok(forces)
    }
}

#[pymethods]
impl BuiltDamper {
    /// Step size (s).
    #[getter]
    fn step_s(&self) -> f64 {
        self.step_s
    }

    /// The precision of the step: float32 or float64.
    #[getter]
    fn dtype<'py>(&self, py: Python<'py>) -> Bound<'py, PyArrayDescr> {
        self.precision().dtype(py)
    }

    /// Number that identifies the built damper, never 0.
    #[getter]
    fn revision(&self) -> u32 {
        in_precision!(&self.kept, constants => constants.revision())
    }

    /// Clearance 2a, the total play (m).
    #[getter]
    fn clearance_m(&self) -> f64 {
        in_precision!(&self.kept, constants => constants.clearance_m().to_f64())
    }

    /// Force at which the element yields (N); no step returns a larger force.
    #[getter]
    fn force_limit_n(&self) -> f64 {
        in_precision!(&self.kept, constants => constants.force_limit_n().to_f64())
    }

    /// Returns the same damper with another clearance 2a (m), changed as in firmware at run time: the table is not
    /// rebuilt, and a state may continue with the returned damper at the next tick.
    ///
    /// >>> import dashpot
    /// >>> dashpot.Damper("paper").build().with_clearance_m(2e-3).clearance_m
    /// 0.0020000000949949026
    fn with_clearance_m(&self, clearance_m: f64) -> Outcome<Self> {
        let mut kept = self.kept.clone();
        match &mut kept {
            Kept::Single(constants) => constants.set_clearance_m(clearance_m as f32)?,
            Kept::Double(constants) => constants.set_clearance_m(clearance_m)?,
        }
        Ok(Self {
            name: self.name.clone(),
            parameters: self.parameters.clone(),
            step_s: self.step_s,
            kept,
        })
    }

    /// Returns a state at rest at a displacement (m), centred in the clearance, without force. A displacement that is
    /// not finite counts as 0.
    #[pyo3(signature = (displacement_m=0.0))]
    pub fn at_rest(slf: &Bound<'_, Self>, displacement_m: f64) -> State {
        let numbers = match &slf.get().kept {
            Kept::Single(constants) => Numbers::Single(constants.at_rest(displacement_m as f32)),
            Kept::Double(constants) => Numbers::Double(constants.at_rest(displacement_m)),
        };
        State::new(numbers, slf.as_any())
    }

    /// Steps one tick and returns the force (N) at a displacement (m) of the seats, positive in extension. It accepts
    /// every displacement: one that is not finite is held, one that moves too fast is limited, and both are latched in
    /// the status of the state.
    fn step(slf: &Bound<'_, Self>, state: &Bound<'_, State>, displacement_m: f64) -> Outcome<f64> {
        let mut state = State::lend(state)?;
        let force = match (&slf.get().kept, &mut state.numbers) {
            (Kept::Single(constants), Numbers::Single(at)) => {
                f64::from(constants.step(at, displacement_m as f32))
            }
            (Kept::Double(constants), Numbers::Double(at)) => constants.step(at, displacement_m),
            _ => return slf.get().other_precision(slf.py()),
        };
        state.stepped_by(slf.as_any());
        Ok(force)
    }

    /// Returns the force (N) at each displacement (m) of `x`, one step per sample, with the bits of the command
    /// `dashpot replay`. It starts at rest at the first sample, or continues from `state`, which it advances. `x` and
    /// `out` are arrays of this damper's precision and are not copied. The GIL is released during the replay, so do not
    /// modify them from another thread.
    ///
    /// >>> import dashpot, numpy
    /// >>> built = dashpot.Damper("in-service").build(step_s=1e-3)
    /// >>> x = (5e-3 * numpy.sin(numpy.arange(1000) / 160)).astype(numpy.float32)
    /// >>> force_n = built.replay(x)
    /// >>> state = built.at_rest(x[0])
    /// >>> bool(numpy.all(force_n == [built.step(state, one) for one in x]))
    /// True
    #[pyo3(signature = (x, *, state=None, out=None))]
    fn replay<'py>(
        slf: &Bound<'py, Self>,
        x: &Bound<'py, PyAny>,
        state: Option<&Bound<'py, State>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> Outcome<Bound<'py, PyAny>> {
        in_precision!(&slf.get().kept, constants => Self::replay_in(slf, constants, x, state, out))
    }

    /// Restores a state saved by `State.to_bytes`, here or in a C or Rust program. Bytes of another damper and damaged
    /// bytes are refused.
    fn state_from_bytes(slf: &Bound<'_, Self>, saved: &[u8]) -> Outcome<State> {
        let numbers = match &slf.get().kept {
            Kept::Single(constants) => Numbers::Single(constants.restore(saved)?),
            Kept::Double(constants) => Numbers::Double(constants.restore(saved)?),
        };
        Ok(State::new(numbers, slf.as_any()))
    }

    fn __repr__(&self, py: Python<'_>) -> String {
        let dtype = self.precision().dtype(py);
        format!(
            "BuiltDamper('{}', step_s={}, dtype={dtype})",
            self.name, self.step_s
        )
    }

    #[staticmethod]
    #[pyo3(name = "_restore")]
    fn restore(
        text: &str,
        name: &str,
        step_s: f64,
        dtype: &Bound<'_, PyAny>,
        clearance_m: f64,
    ) -> Outcome<Self> {
        let parameters = damper::parse(name, text, &[])?;
        let built = Self::new(name, &parameters, step_s, Precision::of(Some(dtype))?)?;
        if built.clearance_m().to_bits() == clearance_m.to_bits() {
            return Ok(built);
        }
        built.with_clearance_m(clearance_m)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Outcome<Pickled<'py>> {
        let built = slf.get();
        let arguments = (
            damper::text(&built.parameters)?,
            built.name.clone(),
            built.step_s,
            built.dtype(slf.py()),
            built.clearance_m(),
        );
        pickled(slf.get_type().getattr("_restore")?, arguments)
    }
}
