//! Calibration of damper parameters, with intervals, from bench tests in memory.

use dashpot_calibration::{
    Assumed, Calibrated as Found, Calibration, LoopTest, PlannedTest, Predicted, Promise, Recorded,
    SKEW,
};
use dashpot_files::sheet::SheetParameters;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::calibration_request::{Samples, index_tests, recorded, request, temperatures_c};
use crate::calibration_words;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_in_thread;
use crate::overrides::path;
use crate::range::{check_step, within};
use crate::whole::Whole;

/// Default number of starts of the search, the same as for the command.
const STARTS: u64 = 4;

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
    predicted: Vec<Predicted>,
    promises: Vec<Promise>,
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

    /// Each held-back test of `validate`, predicted with the calibrated damper: its root mean square error `error_n`,
    /// the same beyond the noise as a share of the force `error_share`, the greatest `systematic` difference over the
    /// velocity or `None`, and further keys as in the JSON of `dashpot calibrate --validate`.
    #[getter]
    fn validation<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyAny>> {
        crate::json::report(py, &self.predicted)
    }

    /// The tests of the sheet `plan` by name, each with what would remain of the standard deviation of each parameter
    /// after that test (1).
    #[getter]
    fn plan<'py>(&self, py: Python<'py>) -> Outcome<Bound<'py, PyDict>> {
        let plan = PyDict::new(py);
        for promise in &self.promises {
            let shares = PyDict::new(py);
            for (key, share) in &promise.shares {
                shares.set_item(key, share)?;
            }
            plan.set_item(&promise.test, shares)?;
        }
        Ok(plan)
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
/// `temperature_c` is the oil's temperature in the recordings (degrees Celsius): a number, or a sequence with one for
/// each of `tests` and then of `validate`, `None` for that of the damper. `vary_each` names parameters that each test
/// has for itself, in the form of `vary`; results call that of the first test `KEY@1`. `validate` has further loops,
/// which are not fitted but predicted. `plan` is a sheet, built in or a file, whose tests are judged by how much each
/// would narrow the intervals.
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
    step_s=0.00025, hold=None, temperature_uncertainty_k=5.0, density_uncertainty_kg_per_m3=0.0,
    max_misfit_percent=20.0, temperature_c=None, vary_each=None, validate=None, plan=None
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
    temperature_c: Option<&Bound<'_, PyAny>>,
    vary_each: Option<&Bound<'_, PyAny>>,
    validate: Option<Vec<Samples<'_>>>,
    plan: Option<&Bound<'_, PyAny>>,
) -> Outcome<Calibrated> {
    check_step(step_s)?;
    let starts = starts.unwrap_or(Whole::Count(STARTS));
    let starts = starts.within("starts", 1..=1000)? as usize;
    let damper = damper.get();
    let mut request = request(vary, vary_each, priors, hold)?;
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
    let planned = match plan {
        Some(sheet) => SheetParameters::load(&path(sheet)?)?.tests,
        None => Vec::new(),
    };
    let planned: Vec<PlannedTest> = planned.into_iter().map(PlannedTest::from).collect();
    let tests = all_recorded("tests", tests)?;
    let held_back = all_recorded("validate", validate)?;
    let temperatures_c = temperatures_c(temperature_c, tests.len() + held_back.len())?;
    let (fitted_c, held_back_c) = temperatures_c.split_at(tests.len());
    let indices = index_tests(indices)?;
    let work = |is_unwanted: &(dyn Fn() -> bool + Sync)| {
        let loops = loops_of(&tests, fitted_c, step_s)?;
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
        let held_back = loops_of(&held_back, held_back_c, step_s)?;
        let predicted = calibration.predicted(&found, held_back)?;
        let promises = match &planned[..] {
            [] => Vec::new(),
            planned => calibration.promises(&found, planned)?,
        };
        Ok::<_, Refusal>((calibration, found, predicted, promises))
    };
    let (calibration, found, predicted, promises) = py.detach(|| run_in_thread(work))??;
    let name = format!("{}, calibrated", damper.name);
    let damper = Py::new(py, Damper::of(name, found.damper.clone())?)?;
    Ok(Calibrated {
        calibration,
        found,
        damper,
        predicted,
        promises,
    })
}

/// Recorded loops from arrays; errors call them `list`.
fn all_recorded(list: &str, tests: Option<Vec<Samples<'_>>>) -> Outcome<Vec<Recorded>> {
    let tests = tests.unwrap_or_default();
    let tests = tests.iter().enumerate();
    tests
        .map(|(number, test)| recorded(list, number, test))
        .collect()
}

/// Tests of the recordings at their temperatures.
fn loops_of(
    recorded: &[Recorded],
    temperatures_c: &[Option<f64>],
    step_s: f64,
) -> Outcome<Vec<LoopTest>> {
    let mut loops = Vec::new();
    for (test, temperature_c) in recorded.iter().zip(temperatures_c) {
        for mut test in LoopTest::from_recording(test, step_s)? {
            test.temperature_c = *temperature_c;
            loops.push(test);
        }
    }
    Ok(loops)
}
