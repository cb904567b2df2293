//! From bench tests in memory to the numbers of a damper, with their intervals.

use dashpot_calibration::{
    Assumed, Calibrated as Found, Calibration, IndexTest, LoopTest, Prior, Recorded, Request, SKEW,
};
use dashpot_core::parameters::STEP_RANGE_S;
use dashpot_testbench::TestbenchError;
use numpy::{Ix1, PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict, PyList};

use crate::arrays;
use crate::calibration_words;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::beside;
use crate::whole::Whole;

/// Starts of the search where none are given, as of the command.
const STARTS: u64 = 4;

/// Arrays of time (s), displacement (m) and force (N).
type Samples<'py> = [Bound<'py, PyAny>; 3];

/// What a calibration has found. `dashpot.calibrate` makes one.
///
/// >>> import dashpot
/// >>> tests = [{"amplitude_m": 0.025, "frequency_hz": hz, "max_extension_force_n": n} for hz, n in ((0.05, 942.3), (0.1, 1883.4))]
/// >>> damper = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0})
/// >>> found = dashpot.calibrate(damper, vary=["reduced.damping_n_s_per_m"], indices=tests)
/// >>> least, greatest = found.intervals["reduced.damping_n_s_per_m"]
/// >>> least < 120e3 < greatest
/// True
#[pyclass(module = "dashpot", frozen)]
pub struct Calibrated {
    calibration: Calibration,
    found: Found,
    damper: Py<Damper>,
}

#[pymethods]
impl Calibrated {
    /// The damper that was found.
    #[getter]
    fn damper(&self, py: Python<'_>) -> Py<Damper> {
        self.damper.clone_ref(py)
    }

    /// The numbers that were varied, by their keys. Two belong to the rig, not to the damper: `sensor_skew_s` is the time (s) by which the force
    /// is recorded later than the displacement, `force_offset_n` what the force sensor shows at no force (N).
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        self.by_key(py, self.found.values.iter())
    }

    /// Their intervals of 95 %, pairs of the least and the greatest value; `None` in a pair where a bound comes first. They include the noise of
    /// the tests and the uncertainty of the oil's temperature and density.
    #[getter]
    fn intervals<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        let intervals = self.found.intervals.iter();
        self.by_key(py, intervals.map(|[least, greatest]| (*least, *greatest)))
    }

    /// What was assumed of the oil and what that does to the numbers, by the key of the assumed one: its `value`, its `uncertainty` (half of an
    /// interval of 95 %), and `shifts`, pairs of how far each number moves at the lower and at the upper end of that interval.
    #[getter]
    fn assumed<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        let assumed = PyDict::new(py);
        for influence in &self.found.influences {
            let one = PyDict::new(py);
            one.set_item("value", influence.value)?;
            one.set_item("uncertainty", influence.uncertainty)?;
            let shifts = influence.shifts.iter().map(|[low, high]| (*low, *high));
            one.set_item("shifts", self.by_key(py, shifts)?)?;
            assumed.set_item(&influence.key, one)?;
        }
        Ok(assumed)
    }

    /// What the numbers alone do not say, in sentences: a model that misses more than noise, a number at its bound, numbers that the tests
    /// hardly tell apart, an assumed temperature that decides a number.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.found
            .warnings
            .iter()
            .map(calibration_words::warning)
            .collect()
    }

    /// Their standard deviations by linear theory, in their units.
    #[getter]
    fn standard_deviations<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        let numbers = self.found.determination.parameters.iter();
        self.by_key(py, numbers.map(|number| number.standard_deviation))
    }

    /// The correlation of each with each, in the order of `values`.
    #[getter]
    fn correlation<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f64>>> {
        match PyArray2::from_vec2(py, &self.found.determination.correlation) {
            Ok(correlation) => Ok(correlation),
            Err(error) => refuse(error),
        }
    }

    /// Each recorded loop beside the model, at the samples that count: arrays `time_s`, `displacement_m`, `force_n`, `before_n` and
    /// `after_n`, the model's as the sensor would show them, the root mean squares of what it misses, `missed_before_n` and `missed_after_n`, and
    /// `displacement_offset_m`, the middle of the motion, on which no force depends.
    #[getter]
    fn loops<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyList>> {
        let step_s = self.calibration.step_s;
        let loops = PyList::empty(py);
        for (test, fit) in self.calibration.loops.iter().zip(&self.found.loops) {
            let one = PyDict::new(py);
            one.set_item("name", &test.name)?;
            one.set_item(
                "time_s",
                PyArray1::from_vec(py, test.counted_times_s(step_s)),
            )?;
            one.set_item(
                "displacement_m",
                PyArray1::from_vec(py, test.counted_displacements_m()),
            )?;
            one.set_item("force_n", PyArray1::from_slice(py, test.counted_forces_n()))?;
            one.set_item("before_n", PyArray1::from_slice(py, &fit.before_n))?;
            one.set_item("after_n", PyArray1::from_slice(py, &fit.after_n))?;
            one.set_item("displacement_offset_m", test.displacement_offset_m)?;
            one.set_item("missed_before_n", fit.missed_before_n)?;
            one.set_item("missed_after_n", fit.missed_after_n)?;
            loops.append(one)?;
        }
        Ok(loops)
    }
}

impl Calibrated {
    fn by_key<'py, V: IntoPyObject<'py>>(
        &self,
        py: Python<'py>,
        values: impl Iterator<Item = V>,
    ) -> Outcome<Bound<'py, PyDict>> {
        let named = PyDict::new(py);
        for (varied, value) in self.calibration.varied.iter().zip(values) {
            named.set_item(&varied.key, value)?;
        }
        Ok(named)
    }
}

/// Finds numbers of `damper` from bench tests: recorded loops `tests`, each of three arrays of float64, time (s), displacement (m) and force
/// (N), or the `indices` of tests, each a dictionary of the columns that `dashpot calibrate --indices` reads.
///
/// `vary` names the numbers, a list of keys, or a dictionary from keys to bounds, pairs or `None` for the plausible ones. `priors` has what is
/// known of them before, pairs of mean and standard deviation; without `known_priors` only these count. Two numbers of the rig are found from
/// loops without being named, `sensor_skew_s` and `force_offset_n`: `vary` and `priors` may name them, and `hold`, a dictionary to values or
/// `None` for zero, keeps them. Without `skew` the sensors record at the same instant. The search begins at `starts` places, 4 where none are
/// given.
///
/// Intervals include what the oil's temperature, known within `temperature_uncertainty_k`, and its density, known within
/// `density_uncertainty_kg_per_m3`, do to the numbers (half-widths of 95 %). What the tests do not determine is refused, and so is a model that
/// misses more than `max_misfit_percent` of a test's force beyond its noise. Ctrl-C ends it.
///
/// >>> import dashpot, numpy
/// >>> made = dashpot.Damper("reduced-vertical", {"mount.clearance_m": 0.0, "reduced.damping_n_s_per_m": 100e3})
/// >>> time_s = numpy.arange(4000) * 1e-3
/// >>> x = 4e-3 * numpy.sin(2 * numpy.pi * time_s)
/// >>> force_n = made.build(1e-3, float).replay(x) + numpy.random.default_rng(1).normal(0, 10, 4000)
/// >>> start = made.replace({"reduced.damping_n_s_per_m": 130e3})
/// >>> found = dashpot.calibrate(start, [(time_s, x, force_n)], ["reduced.damping_n_s_per_m"], step_s=1e-3)
/// >>> abs(found.damper["reduced.damping_n_s_per_m"] / 100e3 - 1) < 0.01
/// True
#[pyfunction]
#[pyo3(signature = (
    damper, tests=None, vary=None, *, indices=None, priors=None, known_priors=true, skew=true, starts=None, step_s=0.00025, hold=None,
    temperature_uncertainty_k=5.0, density_uncertainty_kg_per_m3=0.0, max_misfit_percent=20.0
))]
#[expect(clippy::too_many_arguments, reason = "what Python names when it calls")]
pub fn calibrate(
    py: Python<'_>,
    damper: &Bound<'_, Damper>,
    tests: Option<Vec<Samples<'_>>>,
    vary: Option<&Bound<'_, PyAny>>,
    indices: Option<&Bound<'_, PyAny>>,
    priors: Option<&Bound<'_, PyDict>>,
    known_priors: bool,
    skew: bool,
    starts: Option<Whole>,
    step_s: f64,
    hold: Option<&Bound<'_, PyDict>>,
    temperature_uncertainty_k: f64,
    density_uncertainty_kg_per_m3: f64,
    max_misfit_percent: f64,
) -> Outcome<Calibrated> {
    if !STEP_RANGE_S.contains(&step_s) {
        return Err(TestbenchError::Step { step_s }.into());
    }
    let starts = starts.unwrap_or(Whole::Count(STARTS));
    let starts = starts.within("starts", 1..=1000)? as usize;
    let damper = damper.get();
    let mut request = request(vary, priors, hold)?;
    request.only_own_priors = !known_priors;
    if !skew {
        request.hold.push((SKEW.into(), None));
    }
    request.check(damper.keyed())?;
    let assumed = Assumed {
        temperature_uncertainty_k: within(
            "temperature_uncertainty_k",
            temperature_uncertainty_k,
            [0.0, 1e3],
        )?,
        density_uncertainty_kg_per_m3: within(
            "density_uncertainty_kg_per_m3",
            density_uncertainty_kg_per_m3,
            [0.0, 1e3],
        )?,
        max_misfit: 0.01 * within("max_misfit_percent", max_misfit_percent, [0.1, 1e4])?,
    };
    let tests: Vec<Recorded> = tests
        .unwrap_or_default()
        .iter()
        .enumerate()
        .map(|(number, test)| recorded(number, test))
        .collect::<Outcome<_>>()?;
    let indices = index_tests(indices)?;
    let work = |is_unwanted: &(dyn Fn() -> bool + Sync)| {
        let mut loops = Vec::new();
        for test in &tests {
            loops.extend(LoopTest::from_recording(test, step_s)?);
        }
        // Without loops there is no skew to hold.
        if loops.is_empty() && !skew {
            request.hold.retain(|(key, _)| key != SKEW);
        }
        let (varied, rig) = request.varied(damper.keyed(), &loops)?;
        let calibration = Calibration {
            damper: damper.keyed().clone(),
            varied,
            loops,
            indices,
            step_s,
            starts,
            rig,
            assumed,
        };
        let found = calibration.run_cancellable(&|_| {}, is_unwanted)?;
        Ok::<_, Refusal>((calibration, found))
    };
    let (calibration, found) = py.detach(|| beside(work))??;
    let name = format!("{}, calibrated", damper.name);
    let damper = Py::new(py, Damper::of(name, found.damper.clone())?)?;
    Ok(Calibrated {
        calibration,
        found,
        damper,
    })
}

/// A number of an argument within its range.
fn within(name: &str, value: f64, [least, greatest]: [f64; 2]) -> Outcome<f64> {
    if (least..=greatest).contains(&value) {
        return Ok(value);
    }
    refuse(format!("{name}: {value}, allowed: {least} to {greatest}"))
}

/// What the arguments ask for.
fn request(
    vary: Option<&Bound<'_, PyAny>>,
    priors: Option<&Bound<'_, PyDict>>,
    hold: Option<&Bound<'_, PyDict>>,
) -> Outcome<Request> {
    let mut keys: Vec<(String, Option<[f64; 2]>)> = Vec::new();
    match vary.map(|vary| (vary, vary.cast::<PyDict>())) {
        Some((_, Ok(bounded))) => {
            for (key, bounds) in bounded {
                keys.push((key.extract()?, bounds.extract()?));
            }
        }
        Some((listed, Err(_))) => {
            let listed: Vec<String> = listed.extract()?;
            keys.extend(listed.into_iter().map(|key| (key, None)));
        }
        None => {}
    }
    let mut given: Vec<(String, Prior)> = Vec::new();
    for (key, pair) in priors.into_iter().flatten() {
        let (key, (mean, standard_deviation)): (String, (f64, f64)) =
            (key.extract()?, pair.extract()?);
        if !(standard_deviation > 0.0 && standard_deviation.is_finite()) {
            return refuse(format!(
                "prior {key}: standard deviation {standard_deviation}, allowed: above 0"
            ));
        }
        let prior = Prior {
            mean,
            standard_deviation,
        };
        given.push((key, prior));
    }
    let mut held: Vec<(String, Option<f64>)> = Vec::new();
    for (key, value) in hold.into_iter().flatten() {
        held.push((key.extract()?, value.extract()?));
    }
    Ok(Request {
        vary: keys,
        priors: given,
        hold: held,
        only_own_priors: false,
    })
}

/// A recorded loop of three arrays.
fn recorded(number: usize, [time_s, displacement_m, force_n]: &Samples<'_>) -> Outcome<Recorded> {
    let numbers = |name: &str, array| {
        let array = arrays::read::<f64, Ix1>(name, array).map_err(|refusal| match refusal {
            Refusal::Value(words) => Refusal::Value(format!("tests[{number}]: {words}")),
            other => other,
        })?;
        Ok::<_, Refusal>(array.as_array().to_vec())
    };
    let (times, displacements) = (
        numbers("time", time_s)?,
        numbers("displacement", displacement_m)?,
    );
    let forces = numbers("force", force_n)?;
    Ok(Recorded::new(
        format!("test {number}"),
        times,
        displacements,
        forces,
    )?)
}

/// Tests of which the indices are known.
fn index_tests(indices: Option<&Bound<'_, PyAny>>) -> Outcome<Vec<IndexTest>> {
    let Some(indices) = indices else {
        return Ok(Vec::new());
    };
    let py = indices.py();
    let finite = [("allow_nan", false)].into_py_dict(py)?;
    let text = py
        .import("json")?
        .call_method("dumps", (indices,), Some(&finite));
    let text: String = match text {
        Ok(text) => text.extract()?,
        Err(error) => {
            return refuse(format!(
                "indices: {}; allowed: a list of dicts of Python's own finite numbers, without what was not measured",
                error.value(py)
            ));
        }
    };
    match serde_json::from_str(&text) {
        Ok(tests) => Ok(tests),
        Err(error) => refuse(format!("indices: {error}")),
    }
}
