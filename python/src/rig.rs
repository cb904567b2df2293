//! The bench test of a damper.

use dashpot_core::CheckedParameters;
use dashpot_files::harmonic::Harmonic;
use dashpot_files::sheet::Index;
use dashpot_testbench::bench_sheet::index_value;
use dashpot_testbench::bench_test;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::Outcome;
use crate::interruption::run_cancellable;

/// One settled cycle of a bench test. `Damper.rig` returns it.
///
/// >>> import dashpot
/// >>> cycle = dashpot.Damper("paper").rig(24.875e-3, 0.64)
/// >>> bool(cycle.indices["max_extension_force_n"] == cycle.force_n.max())
/// True
#[pyclass(module = "dashpot", frozen)]
pub struct Cycle(bench_test::Cycle);

impl Cycle {
    /// Runs the test.
    pub fn run(
        py: Python<'_>,
        parameters: &CheckedParameters,
        amplitude_m: f64,
        frequency_hz: f64,
        step_s: f64,
    ) -> Outcome<Self> {
        let motion = Harmonic {
            amplitude_m,
            frequency_hz,
        };
        let run = |is_unwanted: &dyn Fn() -> bool| {
            bench_test::run_cancellable(parameters, motion, step_s, is_unwanted)
        };
        Ok(Self(py.detach(|| run_cancellable(run))??))
    }
}

/// Indices of a cycle by name.
pub fn indices<'py>(py: Python<'py>, cycle: &Cycle) -> Outcome<Bound<'py, PyDict>> {
    let indices = PyDict::new(py);
    for index in Index::ALL {
        indices.set_item(index.key(), index_value(&cycle.0, index))?;
    }
    Ok(indices)
}

#[pymethods]
impl Cycle {
    /// Displacement (m) of the seats at each step, starting one step after zero.
    #[getter]
    fn displacement_m<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.displacements_m)
    }

    /// Velocity (m/s) at each step.
    #[getter]
    fn velocity_m_per_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.0.velocities_m_per_s())
    }

    /// Force (N) at each step.
    #[getter]
    fn force_n<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.forces_n)
    }

    /// The step size used (s): the requested one, shortened so that a cycle is a whole number of steps.
    #[getter]
    fn step_s(&self) -> f64 {
        self.0.step_s
    }

    /// Number of cycles until the force repeated.
    #[getter]
    fn cycles(&self) -> usize {
        self.0.cycles
    }

    /// The indices by name; an index that is undefined without force is `None`.
    #[getter]
    fn indices<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        indices(py, self)
    }
}
