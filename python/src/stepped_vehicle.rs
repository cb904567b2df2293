//! A vehicle that a program steps, with inputs and outputs as arrays.

use std::collections::HashMap;

use dashpot_core::DamperParameters;
use dashpot_files::case::CaseOptions;
use dashpot_files::did_you_mean;
use dashpot_vehicle_run::{Coupled, CoupledCase};
use numpy::{Ix1, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::arrays;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::overrides::{assignments, path};
use crate::replacements::replacements;

/// A vehicle on a track that a program steps and influences: speed, friction, forces on bodies, dampers, and the forces
/// of external dampers. `case` is a shipped case or a file.
///
/// `outside` names dampers whose forces are inputs; `dampers` and `overrides` are those of `dashpot.vehicle`. A value
/// that is set acts from the next tick on and stays until another is set, or until an event of the case changes the
/// same quantity.
///
/// >>> import dashpot, numpy
/// >>> vehicle = dashpot.Vehicle("straight-180")
/// >>> vehicle.set("friction_factor", 0.5)
/// >>> outputs = vehicle.step(100)
/// >>> vehicle.time_s, outputs.shape == (100, len(vehicle.outputs))
/// (0.1, True)
/// >>> vehicle.set("body_applied_lateral_force_n", 20e3)
/// >>> before = vehicle.get("body_lateral_m")
/// >>> _ = vehicle.step(400)
/// >>> vehicle.get("body_lateral_m") > before + 1e-3
/// True
#[pyclass(module = "dashpot")]
pub struct Vehicle {
    case: String,
    vehicle: Coupled,
    /// Indices of the variables by name.
    indices: HashMap<String, usize>,
    inputs: Vec<usize>,
    outputs: Vec<usize>,
}

impl Vehicle {
    fn refused(&self, error: impl std::fmt::Display) -> Refusal {
        Refusal::Value(format!("{}: {error}", self.case))
    }

    fn index(&self, name: &str) -> Outcome<usize> {
        match self.indices.get(name) {
            Some(index) => Ok(*index),
            None => refuse(format!(
                "{}: no variable `{name}`{}",
                self.case,
                did_you_mean(name, self.indices.keys().map(String::as_str))
            )),
        }
    }

    fn names(&self, indices: &[usize]) -> Vec<String> {
        let variables = self.vehicle.variables();
        indices
            .iter()
            .map(|index| variables[*index].name.clone())
            .collect()
    }

    /// Checks that a variable may be set to a value; `what` starts the message.
    fn check(&self, what: &str, index: usize, value: f64) -> Outcome<()> {
        let variable = &self.vehicle.variables()[index];
        let name = &variable.name;
        let Some(input) = variable.input() else {
            return refuse(format!("{what}{name} is an output, allowed: inputs"));
        };
        if input.allows(value) {
            return Ok(());
        }
        let [min, max] = input.allowed();
        refuse(format!("{what}{name} {value}, allowed: {min} to {max}"))
    }

    /// Sets a variable to a value that [`Self::check`] accepts.
    fn put(&mut self, index: usize, value: f64) -> Outcome<()> {
        let set = self.vehicle.set(index, value);
        set.map_err(|error| self.refused(error))
    }

    /// Sets all inputs; all are checked before any is set.
    fn put_all(&mut self, inputs: &Bound<'_, PyAny>) -> Outcome<()> {
        let given = arrays::read::<f64, Ix1>("inputs", inputs)?;
        let values = given.as_slice().map_err(PyErr::from)?;
        let (found, expected) = (values.len(), self.inputs.len());
        if found != expected {
            return refuse(format!(
                "inputs: {found} values, allowed: {expected}, one for each input"
            ));
        }
        for (index, value) in self.inputs.iter().zip(values) {
            self.check("inputs: ", *index, *value)?;
        }
        for (number, value) in values.iter().enumerate() {
            self.put(self.inputs[number], *value)?;
        }
        Ok(())
    }
}

#[pymethods]
impl Vehicle {
    #[new]
    #[pyo3(signature = (case, *, outside=Vec::new(), dampers=None, overrides=None))]
    fn new(
        py: Python<'_>,
        case: &Bound<'_, PyAny>,
        outside: Vec<String>,
        dampers: Option<&Bound<'_, PyAny>>,
        overrides: Option<&Bound<'_, PyAny>>,
    ) -> Outcome<Self> {
        let mut options = CaseOptions::load(&path(case)?)?;
        options.dampers.extend(replacements(dampers)?);
        options.overrides.extend(assignments(overrides)?);
        let case = options.case()?;
        let of_case = |error| Refusal::of_case(&case.name, error);
        let vehicle = py.detach(|| {
            let coupled = CoupledCase::new(&case, &outside)?;
            Coupled::new(&coupled, &coupled.contact()?.tables()?)
        });
        let vehicle = vehicle.map_err(of_case)?;
        let variables = vehicle.variables().iter().enumerate();
        let is_input = |index: &usize| vehicle.variables()[*index].input().is_some();
        let (inputs, outputs) = (0..vehicle.variables().len()).partition(is_input);
        Ok(Self {
            case: case.name,
            indices: variables
                .map(|(index, variable)| (variable.name.clone(), index))
                .collect(),
            inputs,
            outputs,
            vehicle,
        })
    }

    /// Names of the inputs: forces of external dampers (N), `speed_m_per_s`, `friction_factor`, and for each body the
    /// lateral and vertical force and the roll, pitch and yaw moment that are applied to its centre.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        self.names(&self.inputs)
    }

    /// Names of the outputs: the signals of `VehicleRun.history`, without the time.
    #[getter]
    fn outputs(&self) -> Vec<String> {
        self.names(&self.outputs)
    }

    /// Step (s).
    #[getter]
    fn step_s(&self) -> f64 {
        self.vehicle.step_s()
    }

    /// Time since the start (s).
    #[getter]
    fn time_s(&self) -> f64 {
        self.vehicle.time_s()
    }

    /// How the run ended, in words; `None` while it goes on.
    #[getter]
    fn ending(&self) -> Option<String> {
        self.vehicle.ending().map(ToString::to_string)
    }

    /// Sets an input from the next tick on.
    fn set(&mut self, name: &str, value: f64) -> Outcome<()> {
        let index = self.index(name)?;
        self.check("", index, value)?;
        self.put(index, value)
    }

    /// Returns the value of an input or output.
    fn get(&self, name: &str) -> Outcome<f64> {
        let index = self.index(name)?;
        Ok(self.vehicle.value(index).unwrap_or_default())
    }

    /// Replaces a damper, named with its number as in `front lateral damper 1`; its force stays continuous. `reset` and
    /// `restore` bring back the dampers of the case.
    fn replace_damper(&mut self, name: &str, damper: &Bound<'_, Damper>) -> Outcome<()> {
        let parameters = DamperParameters::clone(&damper.get().parameters);
        let replaced = self.vehicle.replace_damper(name, &parameters);
        replaced.map_err(|error| self.refused(error))
    }

    /// Runs `ticks` ticks and returns an array with a row of all outputs after each; fewer rows if the run ends, and
    /// none after its end. `ending` then gives the reason.
    ///
    /// `inputs` is one value for each of `Vehicle.inputs`; without it the inputs stay as they are.
    #[pyo3(signature = (ticks=1, inputs=None))]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        ticks: usize,
        inputs: Option<&Bound<'py, PyAny>>,
    ) -> Outcome<Bound<'py, PyArray2<f64>>> {
        if let Some(inputs) = inputs {
            self.put_all(inputs)?;
        }
        let mut rows: Vec<f64> = Vec::new();
        for tick in 0..ticks {
            if tick % 256 == 0 {
                py.check_signals()?;
            }
            let taken = self.vehicle.step(1).map_err(|error| self.refused(error))?;
            if taken == 0 {
                break;
            }
            let values = self.outputs.iter().map(|index| self.vehicle.value(*index));
            rows.extend(values.map(Option::unwrap_or_default));
        }
        let columns = self.outputs.len();
        let count = rows.len() / columns;
        Ok(PyArray1::from_vec(py, rows).reshape([count, columns])?)
    }

    /// Returns to the start of the case.
    fn reset(&mut self) {
        self.vehicle.reset();
    }

    /// Saves the state for `restore`, as bytes.
    fn save<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyBytes>> {
        let saved = self.vehicle.save().map_err(|error| self.refused(error))?;
        Ok(PyBytes::new(py, &saved))
    }

    /// Goes on from a state that a vehicle of the same case saved.
    fn restore(&mut self, state: &[u8]) -> Outcome<()> {
        if self.vehicle.restore(state).is_err() {
            return refuse("state: not the state of a vehicle of this case");
        }
        Ok(())
    }

    fn __repr__(&self) -> String {
        let time_s = self.vehicle.time_s();
        match self.vehicle.ending() {
            Some(ending) => format!("<Vehicle '{}', {ending}>", self.case),
            None => format!("<Vehicle '{}', {time_s:.3} s>", self.case),
        }
    }
}
