//! A damper: its parameters by key, and the objects and results computed from them.

use dashpot_core::CheckedParameters;
use dashpot_core::characteristic::Characteristic;
use dashpot_files::damper::{self, KeyedParameters};
use dashpot_testbench::verification::reference_forces_cancellable;
use numpy::{Ix1, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyList};

use crate::arrays::{self, Precision};
use crate::built::BuiltDamper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_cancellable;
use crate::overrides::assignments;
use crate::pickled::{Pickled, pickled};
use crate::rig::{Cycle, indices};

/// A damper: a preset or the TOML file at a path, with other values for the keys of `overrides`.
///
/// It is a mapping from keys `table.key` to values in SI units.
///
/// >>> import dashpot
/// >>> damper = dashpot.Damper("in-service", {"mount.clearance_m": 1e-3})
/// >>> damper["mount.clearance_m"]
/// 0.001
/// >>> damper
/// Damper('in-service', mount.clearance_m=0.001)
#[pyclass(module = "dashpot", frozen, mapping)]
pub struct Damper {
    /// Name of the damper, followed by its overrides.
    pub name: String,
    pub parameters: CheckedParameters,
    keyed: KeyedParameters,
}

impl Damper {
    /// Creates a damper from checked parameters; errors call the damper `name`.
    pub fn of(name: String, parameters: CheckedParameters) -> Outcome<Self> {
        let keyed = KeyedParameters::new(&name, &parameters)?;
        Ok(Self {
            name,
            parameters,
            keyed,
        })
    }

    /// Parameters by key.
    pub fn keyed(&self) -> &KeyedParameters {
        &self.keyed
    }

    /// Looks up a key, which may be a Python object of any type.
    fn at(&self, key: &Bound<'_, PyAny>) -> Option<f64> {
        self.keyed.number(&key.extract::<String>().ok()?).ok()
    }

    /// The damper as a reader of Python knows it.
    pub fn called(&self) -> String {
        match self.name.split_once(", ") {
            Some((name, changes)) => format!("Damper('{name}', {changes})"),
            None => format!("Damper('{}')", self.name),
        }
    }

    /// Text of the damper as a damper file.
    pub fn text(&self) -> Outcome<String> {
        Ok(damper::text(&self.parameters)?)
    }
}

/// Name followed by its overrides.
fn changed(name: &str, assignments: &[String]) -> String {
    let changes = assignments.iter().map(|one| format!(", {one}"));
    format!("{name}{}", changes.collect::<String>())
}

#[pymethods]
impl Damper {
    #[new]
    #[pyo3(signature = (name, overrides=None))]
    fn new(name: &Bound<'_, PyAny>, overrides: Option<&Bound<'_, PyAny>>) -> Outcome<Self> {
        let name = crate::overrides::path(name)?;
        let changes = assignments(overrides)?;
        let parameters = damper::load(&name, &changes)?;
        Self::of(changed(&name, &changes), parameters)
    }

    /// Reads the damper from `text`, the contents of a damper file; errors call the damper `name`.
    ///
    /// >>> import dashpot
    /// >>> text = dashpot.Damper("reduced-vertical").to_toml()
    /// >>> dashpot.Damper.from_toml(text)["reduced.damping_n_s_per_m"]
    /// 120000.0
    #[staticmethod]
    #[pyo3(signature = (text, overrides=None, name="damper"))]
    fn from_toml(text: &str, overrides: Option<&Bound<'_, PyAny>>, name: &str) -> Outcome<Self> {
        let changes = assignments(overrides)?;
        let parameters = damper::parse(name, text, &changes)?;
        Self::of(changed(name, &changes), parameters)
    }

    /// Returns the text of a damper file; `from_toml` reads the same damper from it.
    ///
    /// >>> import dashpot
    /// >>> print(dashpot.Damper("reduced-lateral").to_toml().splitlines()[0])
    /// [reduced]
    fn to_toml(&self) -> Outcome<String> {
        self.text()
    }

    /// Returns the damper with other values for these keys.
    ///
    /// >>> import dashpot
    /// >>> worn = dashpot.Damper("in-service").replace({"mount.clearance_m": 3e-3})
    /// >>> worn["mount.clearance_m"]
    /// 0.003
    fn replace(&self, overrides: &Bound<'_, PyAny>) -> Outcome<Self> {
        let changes = assignments(Some(overrides))?;
        let parameters = damper::change(&self.name, &self.parameters, &changes)?;
        Self::of(changed(&self.name, &changes), parameters)
    }

    /// Name of the damper in errors.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// All keys, in order.
    ///
    /// >>> import dashpot
    /// >>> dashpot.Damper("reduced-vertical").keys()[:2]
    /// ['limits.displacement_m', 'limits.force_n']
    fn keys(&self) -> Vec<String> {
        self.keyed.keys()
    }

    /// All values, in the order of the keys.
    ///
    /// >>> import dashpot
    /// >>> dashpot.Damper("reduced-vertical").values()[:2]
    /// [0.5, 50000.0]
    fn values(&self) -> Outcome<Vec<f64>> {
        Ok(self.items()?.into_iter().map(|(_, value)| value).collect())
    }

    /// Pairs of keys and values, in order.
    ///
    /// >>> import dashpot
    /// >>> dashpot.Damper("reduced-vertical").items()[2]
    /// ('limits.rate_m_per_s', 2.0)
    fn items(&self) -> Outcome<Vec<(String, f64)>> {
        let keys = self.keyed.keys().into_iter();
        keys.map(|key| Ok((key.clone(), self.keyed.number(&key)?)))
            .collect()
    }

    /// Returns the value of a key, or `default` if this damper lacks the key.
    ///
    /// >>> import dashpot
    /// >>> dashpot.Damper("reduced-vertical").get("oil.density_kg_per_m3", 850.0)
    /// 850.0
    #[pyo3(signature = (key, default=None, /))]
    fn get<'py>(
        &self,
        key: &Bound<'py, PyAny>,
        default: Option<Bound<'py, PyAny>>,
    ) -> Option<Bound<'py, PyAny>> {
        match self.at(key) {
            Some(number) => Some(PyFloat::new(key.py(), number).into_any()),
            None => default,
        }
    }

    fn __getitem__(&self, key: &str) -> Outcome<f64> {
        let number = self.keyed.number(key);
        number.map_err(|error| Refusal::Key(error.to_string()))
    }

    fn __contains__(&self, key: &Bound<'_, PyAny>) -> bool {
        self.at(key).is_some()
    }

    fn __len__(&self) -> usize {
        self.keyed.keys().len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyList::new(py, self.keyed.keys())?.try_iter()?.into_any())
    }

    /// Builds the damper for a fixed step (s), in the precision of `dtype`: float32 by default, as on the target.
    ///
    /// >>> import dashpot
    /// >>> dashpot.Damper("paper").build(step_s=1e-3).step_s
    /// 0.001
    #[pyo3(signature = (step_s=1e-3, dtype=None))]
    fn build(&self, step_s: f64, dtype: Option<&Bound<'_, PyAny>>) -> Outcome<BuiltDamper> {
        let precision = Precision::of(dtype)?;
        BuiltDamper::new(&self.name, &self.parameters, step_s, precision)
    }

    /// Runs the bench test in double precision, with steps of at most `step_s` (s): the seats move harmonically until
    /// the force repeats.
    ///
    /// >>> import dashpot
    /// >>> cycle = dashpot.Damper("paper").rig(amplitude_m=24.875e-3, frequency_hz=0.64)
    /// >>> cycle.force_n.shape == cycle.velocity_m_per_s.shape
    /// True
    #[pyo3(signature = (amplitude_m, frequency_hz, step_s=1e-4))]
    fn rig(
        &self,
        py: Python<'_>,
        amplitude_m: f64,
        frequency_hz: f64,
        step_s: f64,
    ) -> Outcome<Cycle> {
        Cycle::run(py, &self.parameters, amplitude_m, frequency_hz, step_s)
    }

    /// Returns the indices of the bench test by name; an index that is undefined without force is `None`.
    ///
    /// >>> import dashpot
    /// >>> damper = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0})
    /// >>> indices = damper.indices(amplitude_m=1e-3, frequency_hz=1.0)
    /// >>> round(indices["max_extension_force_n"])  # C w A/sqrt(1 + (w C/K)^2)
    /// 751
    #[pyo3(signature = (amplitude_m, frequency_hz, step_s=1e-4))]
    fn indices<'py>(
        &self,
        py: Python<'py>,
        amplitude_m: f64,
        frequency_hz: f64,
        step_s: f64,
    ) -> Outcome<Bound<'py, PyDict>> {
        let cycle = Cycle::run(py, &self.parameters, amplitude_m, frequency_hz, step_s)?;
        indices(py, &cycle)
    }

    /// Returns the force (N) at each constant velocity (m/s), after the springs have settled and the clearance is taken
    /// up; both are positive in extension.
    ///
    /// >>> import dashpot, numpy
    /// >>> damper = dashpot.Damper("reduced-vertical")
    /// >>> damper.characteristic(numpy.array([0.01, -0.1])).tolist()
    /// [1200.0, -3600.0]
    fn characteristic<'py>(
        &self,
        py: Python<'py>,
        velocity_m_per_s: &Bound<'py, PyAny>,
    ) -> Outcome<Bound<'py, PyArray1<f64>>> {
        let velocities = arrays::read::<f64, Ix1>("velocity_m_per_s", velocity_m_per_s)?;
        let velocities = velocities.as_slice().map_err(PyErr::from)?;
        if let Some(wrong) = velocities.iter().find(|velocity| !velocity.is_finite()) {
            return refuse(format!(
                "velocity_m_per_s: {wrong}, allowed: finite numbers"
            ));
        }
        let parameters = &self.parameters;
        let forces: Vec<f64> = py.detach(|| {
            let characteristic = Characteristic::new(parameters);
            let force = |velocity: &f64| characteristic.force_n(*velocity);
            velocities.iter().map(force).collect()
        });
        Ok(PyArray1::from_vec(py, forces))
    }

    /// Returns the force (N) of the reference solution at displacements (m) of the seats. They are `step_s` (s) apart
    /// and linear in between. The reference is an adaptive solver, written independently of the step, and about a
    /// thousand times slower.
    ///
    /// >>> import dashpot, numpy
    /// >>> damper, x = dashpot.Damper("paper"), 5e-3 * numpy.sin(numpy.arange(500.0) / 80)
    /// >>> fixed = damper.build(1e-3, numpy.float64).replay(x)
    /// >>> error = damper.reference(x, 1e-3) - fixed
    /// >>> bool(abs(error).max() < 0.01 * abs(fixed).max())
    /// True
    fn reference<'py>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
        step_s: f64,
    ) -> Outcome<Bound<'py, PyArray1<f64>>> {
        let motion = arrays::read::<f64, Ix1>("x", x)?;
        let displacements = motion.as_slice().map_err(PyErr::from)?;
        let parameters = &self.parameters;
        let solve = |is_unwanted: &dyn Fn() -> bool| {
            reference_forces_cancellable(parameters, step_s, displacements, is_unwanted)
        };
        Ok(PyArray1::from_vec(
            py,
            py.detach(|| run_cancellable(solve))??,
        ))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<Self>();
        other.is_ok_and(|other| *other.get().parameters == *self.parameters)
    }

    fn __hash__(&self) -> Outcome<isize> {
        use std::hash::{DefaultHasher, Hash, Hasher};
        let mut hasher = DefaultHasher::new();
        self.text()?.hash(&mut hasher);
        Ok(hasher.finish() as isize)
    }

    fn __repr__(&self) -> String {
        self.called()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> Outcome<Pickled<'py>> {
        let damper = slf.get();
        let make = slf.get_type().getattr("from_toml")?;
        let arguments = (damper.text()?, None::<Py<PyAny>>, damper.name.clone());
        pickled(make, arguments)
    }
}
