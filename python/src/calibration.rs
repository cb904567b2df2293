//! Calibration of damper parameters, with intervals, from bench tests in memory.

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
use crate::interruption::run_in_thread;
use crate::whole::Whole;

/// Default number of starts of the search, the same as for the command.
const STARTS: u64 = 4;

/// Arrays of time (s), displacement (m) and force (N).
type Samples<'py> = [Bound<'py, PyAny>; 3];

/// Result of a calibration. `dashpot.calibrate` returns it.
///
/// >>> import dashpot
/// >>> points = [(0.05, 942.3), (0.1, 1883.4)]
/// >>> tests = [{"amplitude_m": 0.025, "frequency_hz": hz, "max_extension_force_n": n} for hz, n in points]
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
    /// The calibrated damper.
    #[getter]
    fn damper(&self, py: Python<'_>) -> Py<Damper> {
        self.damper.clone_ref(py)
    }

    /// The fitted parameters by key. Two belong to the rig rather than to the damper: `sensor_skew_s` is the delay (s)
    /// of the recorded force relative to the displacement, and `force_offset_n` is the force sensor's reading (N) at
    /// zero force.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        self.by_key(py, self.found.values.iter())
    }

    /// Intervals (95 %) of the fitted parameters, as pairs of minimum and maximum; `None` in a pair means that the
    /// parameter reached a bound first. The intervals include the noise of the tests and the uncertainty of the oil's
    /// temperature and density.
    #[getter]
    fn intervals<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        let intervals = self.found.intervals.iter();
        self.by_key(py, intervals.map(|[min, max]| (*min, *max)))
    }

    /// Assumed properties of the oil by key, and their effect on the parameters: `value`, `uncertainty` (half of a 95 %
    /// interval), and `shifts`, pairs with the shift of each parameter at the lower and at the upper end of that
    /// interval.
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

    /// Warnings about the result, one sentence each: a misfit larger than the noise, a parameter at its bound,
    /// parameters that the tests hardly distinguish, or an assumed temperature that dominates a parameter.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.found
            .warnings
            .iter()
            .map(calibration_words::warning)
            .collect()
    }

    /// Standard deviations of the fitted parameters from linear theory, in the units of the parameters.
    #[getter]
    fn standard_deviations<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        let numbers = self.found.determination.parameters.iter();
        self.by_key(py, numbers.map(|number| number.standard_deviation))
    }

    /// Correlation matrix of the parameters, in the order of `values`.
    #[getter]
    fn correlation<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyArray2<f64>>> {
        match PyArray2::from_vec2(py, &self.found.determination.correlation) {
            Ok(correlation) => Ok(correlation),
            Err(error) => refuse(error),
        }
    }

    /// Each recorded loop and the model's loop before and after the fit, at the samples that count in the fit: arrays
    /// `time_s`, `displacement_m`, `force_n`, `before_n` and `after_n` (the model's forces as the sensor would show
    /// them), the RMS misfits `missed_before_n` and `missed_after_n`, and `displacement_offset_m`, the mean of the
    /// motion, which does not affect the force.
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

/// Fits parameters of `damper` to bench tests: recorded loops `tests`, each consisting of three float64 arrays, time
/// (s), displacement (m) and force (N), or the `indices` of tests, each a dictionary with the columns that `dashpot
/// calibrate --indices` reads.
///
/// `vary` names the parameters, as a list of keys or as a dictionary from keys to bounds, where `None` selects the
/// plausible ones. `priors` contains prior knowledge as pairs of mean and standard deviation; with `known_priors=False`
/// only these apply. Two parameters of the rig are always fitted to loops, `sensor_skew_s` and `force_offset_n`: `vary`
/// and `priors` may name them, and `hold` fixes them: it is a dictionary from their keys to values, or to `None` for
/// zero. With `skew=False` the sensors are assumed to record at the same instant. The search has `starts` starting
/// points, 4 by default.
///
/// Intervals include the effect of the oil's temperature, known within `temperature_uncertainty_k`, and its density,
/// known within `density_uncertainty_kg_per_m3` (half-widths of 95 % intervals). Parameters that the tests do not
/// determine are refused, and so is a model whose misfit beyond the noise exceeds `max_misfit_percent` of a test's
/// force. Ctrl-C cancels the fit.
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
    damper, tests=None, vary=None, *, indices=None, priors=None, known_priors=true, skew=true, starts=None,
    step_s=0.00025, hold=None, temperature_uncertainty_k=5.0, density_uncertainty_kg_per_m3=0.0, max_misfit_percent=20.0
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
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
        // Without loops there is no skew, so it cannot be held.
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
    let (calibration, found) = py.detach(|| run_in_thread(work))??;
    let name = format!("{}, calibrated", damper.name);
    let damper = Py::new(py, Damper::of(name, found.damper.clone())?)?;
    Ok(Calibrated {
        calibration,
        found,
        damper,
    })
}

/// Checks that an argument is within its range.
fn within(name: &str, value: f64, [min, max]: [f64; 2]) -> Outcome<f64> {
    if (min..=max).contains(&value) {
        return Ok(value);
    }
    refuse(format!("{name}: {value}, allowed: {min} to {max}"))
}

/// Builds the request from the arguments.
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
        vary_each: Vec::new(),
        vary: keys,
        priors: given,
        hold: held,
        only_own_priors: false,
    })
}

/// Builds a recorded loop from three arrays.
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

/// Reads tests that give only their indices.
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
                "indices: {}; allowed: a list of dicts of finite Python numbers; leave out indices that were not \
                 measured",
                error.value(py)
            ));
        }
    };
    match serde_json::from_str(&text) {
        Ok(tests) => Ok(tests),
        Err(error) => refuse(format!("indices: {error}")),
    }
}
