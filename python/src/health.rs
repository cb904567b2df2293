//! Health of a damper from recorded displacement and force.

use std::path::Path;
use std::rc::Rc;

use dashpot_calibration::Recorded;
use dashpot_calibration::cause::{Causes, end_of};
use dashpot_core::health::{Baseline, Estimate, HealthReading};
use dashpot_recording::{MeasuredSample, Measurement};
use dashpot_testbench::health::{
    History, Noise, Reading, alarm_in_words, alarm_name, doubts_in_words,
};
use dashpot_testbench::recorded_health::{self, NOISE_NEEDS, history_cancellable};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::class::Class;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_in_thread;
use crate::range::check_step;
use crate::recording::arrays_of;
use crate::sensors::{Sensors, model};

const MODULE: &str = "dashpot._health";
static HEALTH: Class = Class::new(MODULE, "Health");
static ESTIMATE: Class = Class::new(MODULE, "Estimate");
static STATUS: Class = Class::new(MODULE, "HealthStatus");
static ALARM: Class = Class::new(MODULE, "HealthAlarm");
static CAUSE: Class = Class::new(MODULE, "HealthCause");

/// Name of a recording in arrays, for errors.
const RECORDING: &str = "recording";

/// An estimate of a reading.
type Estimated = fn(&HealthReading) -> Estimate;

/// Estimates of a reading by name.
const ESTIMATES: [(&str, Estimated); 8] = [
    ("flow_factor", |reading| reading.flow_factor),
    ("damping_factor", HealthReading::damping_factor),
    ("stiffness_n_per_m", |reading| reading.stiffness_n_per_m),
    ("clearance_m", |reading| reading.clearance_m),
    ("lag_s", |reading| reading.lag_s),
    ("compliance_m_per_n", |reading| reading.compliance_m_per_n),
    ("force_zero_n", |reading| reading.force_zero_n),
    ("added_friction_n", |reading| reading.added_friction_n),
];

/// Estimates the health of a damper from its recorded motion and force, as `dashpot replay --health`: damping,
/// stiffness and clearance with standard deviations, alarms, and the likely cause of a change.
///
/// `recording` has the float64 arrays `time_s`, `displacement_m` and `force_n`: a dictionary, as `dashpot.read(path,
/// with_force=True)` returns it, or a sequence of the three. It is resampled to ticks of `step_s` (s). Noise that is
/// not given is estimated from the recording. `memory_s` is the time in contact after which the weight of a sample
/// drops to 1/e (default 1 s), `law_deviation` the relative error of the model of a healthy damper within a stroke
/// (default 0.05), `lag_s` the lag of the measured force and `lag_sd_s` its standard deviation (default 0 and 1 ms).
///
/// `baseline` is the result of a recording of the damper when it was healthy; without it, the damper itself is the
/// baseline. Ctrl-C cancels the estimate.
///
/// >>> import dashpot, numpy
/// >>> damper, time_s = dashpot.Damper("in-service"), numpy.arange(8000) * 1e-3
/// >>> x = 5e-3 * numpy.sin(8 * time_s) + 1e-3 * numpy.sin(50 * time_s)
/// >>> noise = numpy.random.default_rng(1).normal(size=(2, len(x)))
/// >>> force_n = damper.build(1e-3, float).replay(x)
/// >>> dashpot.health(damper, (time_s, x + 1e-5 * noise[0], force_n + 20 * noise[1])).alarms
/// []
#[pyfunction]
#[pyo3(signature = (
    damper, recording, *, step_s=0.001, displacement_noise_m=None, force_noise_n=None,
    memory_s=None, law_deviation=None, lag_s=None, lag_sd_s=None, baseline=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn health<'py>(
    py: Python<'py>,
    damper: &Bound<'py, Damper>,
    recording: &Bound<'py, PyAny>,
    step_s: f64,
    displacement_noise_m: Option<f64>,
    force_noise_n: Option<f64>,
    memory_s: Option<f64>,
    law_deviation: Option<f64>,
    lag_s: Option<f64>,
    lag_sd_s: Option<f64>,
    baseline: Option<&Bound<'py, PyAny>>,
) -> Outcome<Bound<'py, PyAny>> {
    check_step(step_s)?;
    let sensors = Sensors {
        displacement_noise_m,
        force_noise_n,
        memory_s,
        law_deviation,
        lag_s,
        lag_sd_s,
    };
    let names = ["time_s", "displacement_m", "force_n"];
    let [times_s, displacements_m, forces_n] = arrays_of(recording, names)?;
    let recorded = Recorded::new(RECORDING.into(), times_s, displacements_m, forces_n)?;
    let baseline = baseline.map(as_baseline).transpose()?;
    let damper = damper.get();
    let work = |is_unwanted: &(dyn Fn() -> bool + Sync)| {
        watched(damper, recorded, sensors, baseline, step_s, is_unwanted)
    };
    let watched = py.detach(|| run_in_thread(work))??;
    in_python(py, &watched)
}

/// A finished estimate.
struct Watched {
    history: History,
    last: HealthReading,
    noise: Noise,
    causes: Option<Causes>,
}

fn watched(
    damper: &Damper,
    recorded: Recorded,
    sensors: Sensors,
    baseline: Option<Baseline>,
    step_s: f64,
    is_unwanted: &dyn Fn() -> bool,
) -> Outcome<Watched> {
    let samples = recorded.times_s.iter().zip(&recorded.displacements_m);
    let samples = samples
        .zip(&recorded.forces_n)
        .map(|((time_s, displacement_m), force_n)| MeasuredSample {
            time_s: *time_s,
            displacement_m: *displacement_m,
            force_n: *force_n,
        });
    let samples = Rc::new(samples.collect::<Vec<_>>());
    let measurement = || Measurement::from_samples(Path::new(RECORDING), Rc::clone(&samples));
    let noise = match (sensors.displacement_noise_m, sensors.force_noise_n) {
        (Some(displacement_m), Some(force_n)) => Some(Noise {
            displacement_m,
            force_n,
        }),
        _ => recorded_health::noise(measurement(), step_s)?,
    };
    let Some(noise) = noise else {
        return refuse(format!(
            "{NOISE_NEEDS}; give displacement_noise_m and force_noise_n"
        ));
    };
    let settings = sensors.settings(noise);
    let mut model = model(&damper.parameters, &settings, step_s)?;
    if let Some(baseline) = baseline {
        model
            .set_baseline(baseline)
            .map_err(|error| Refusal::Value(format!("baseline: {error}")))?;
    }
    let (history, _) = history_cancellable(measurement(), &model, step_s, step_s, is_unwanted)?;
    let Some(last) = history.last().copied() else {
        return refuse("the recording has no samples to estimate from");
    };
    let causes = match baseline {
        _ if is_unwanted() => None,
        Some(_) => None,
        None => {
            let end = end_of(measurement(), RECORDING.into())?;
            Causes::find(damper.keyed(), &end, step_s).ok()
        }
    };
    let noise = Noise {
        displacement_m: settings.displacement_noise_m,
        force_n: settings.force_noise_n,
    };
    Ok(Watched {
        history,
        last,
        noise,
        causes,
    })
}

/// The baseline that an earlier result is.
fn as_baseline(earlier: &Bound<'_, PyAny>) -> Outcome<Baseline> {
    let estimate = |name: &str| -> PyResult<Estimate> {
        let (value, sd) = earlier.getattr(name)?.extract()?;
        Ok(Estimate { value, sd })
    };
    let estimates = [
        estimate("flow_factor")?,
        estimate("compliance_m_per_n")?,
        estimate("clearance_m")?,
    ];
    let samples = earlier.getattr("samples")?.extract()?;
    let rejected = earlier.getattr("rejected")?.extract()?;
    let baseline = recorded_health::baseline(estimates, samples, rejected);
    baseline.map_err(|reason| Refusal::Value(format!("baseline: {reason}")))
}

fn in_python<'py>(py: Python<'py>, watched: &Watched) -> Outcome<Bound<'py, PyAny>> {
    let Watched {
        history,
        last,
        noise,
        causes,
    } = watched;
    let found = PyDict::new(py);
    for (name, of) in ESTIMATES {
        let Estimate { value, sd } = of(last);
        found.set_item(name, ESTIMATE.make(py, (value, sd))?)?;
    }
    found.set_item("samples", last.samples)?;
    found.set_item("rejected", last.rejected)?;
    found.set_item("status", STATUS.make(py, (last.status.bits(),))?)?;
    found.set_item("is_trusted", last.is_trusted())?;
    found.set_item("displacement_noise_m", noise.displacement_m)?;
    found.set_item("force_noise_n", noise.force_n)?;
    let alarms = PyList::empty(py);
    for (alarm, time_s) in &history.alarms {
        let words = alarm_in_words(*alarm, last);
        alarms.append(ALARM.make(py, (alarm_name(*alarm), *time_s, words))?)?;
    }
    found.set_item("alarms", alarms)?;
    found.set_item("doubts", doubts_in_words(last))?;
    let remarks = causes.as_ref().map_or_else(Vec::new, Causes::remarks);
    found.set_item("remarks", remarks)?;
    found.set_item(
        "causes",
        causes
            .as_ref()
            .map(|causes| causes_in_python(py, causes))
            .transpose()?,
    )?;
    found.set_item("history", history_in_python(py, &history.readings)?)?;
    HEALTH.make_of(&found)
}

fn causes_in_python<'py>(py: Python<'py>, causes: &Causes) -> Outcome<Bound<'py, PyList>> {
    let listed = PyList::empty(py);
    for cause in &causes.causes {
        let kind = crate::json::report(py, &cause.kind)?;
        let words = cause.to_string();
        listed.append(CAUSE.make(py, (kind, cause.value, cause.probability, words))?)?;
    }
    Ok(listed)
}

/// Arrays over time.
fn history_in_python<'py>(py: Python<'py>, readings: &[Reading]) -> Outcome<Bound<'py, PyDict>> {
    let history = PyDict::new(py);
    let column = |of: &dyn Fn(&Reading) -> f64| {
        PyArray1::from_vec(py, readings.iter().map(of).collect::<Vec<f64>>())
    };
    history.set_item("time_s", column(&|reading| reading.time_s))?;
    for (name, of) in ESTIMATES {
        let value = column(&|reading| of(&reading.reading).value.into());
        history.set_item(name, value)?;
        let sd = column(&|reading| of(&reading.reading).sd.into());
        history.set_item(format!("{name}_sd"), sd)?;
    }
    let status = readings
        .iter()
        .map(|reading| i64::from(reading.reading.status.bits()));
    history.set_item(
        "status",
        PyArray1::from_vec(py, status.collect::<Vec<i64>>()),
    )?;
    history.set_item("min_force_n", column(&|reading| reading.force_n[0]))?;
    history.set_item("max_force_n", column(&|reading| reading.force_n[1]))?;
    history.set_item("used_share", column(&|reading| reading.used_share))?;
    Ok(history)
}
