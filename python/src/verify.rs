//! The fixed step compared with the reference solver.

use std::path::Path;
use std::rc::Rc;

use dashpot_recording::{Recording, Sample};
use dashpot_testbench::TestbenchError;
use dashpot_testbench::step_errors::StepErrors;
use dashpot_testbench::verification::on_recording;
use pyo3::prelude::*;
use pyo3::types::{PyAnyMethods, PyDict, PyList};
use serde::Serialize;

use crate::class::Class;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_in_thread;
use crate::json;
use crate::range::check_step;
use crate::recording::arrays_of;

const MODULE: &str = "dashpot._verify";
static STEP_ERROR: Class = Class::new(MODULE, "StepError");
static RECORDED_ERROR: Class = Class::new(MODULE, "RecordedError");

/// Measures the accuracy of the fixed step against the adaptive reference solver, as `dashpot verify`: two rows for
/// each step of `step_s` (s), one in each precision.
///
/// Without a recording the damper follows about a hundred motions scaled to it, and each row is a `dashpot.StepError`;
/// `top_speed_m_per_s` is the top speed of the motions. `recording` has the float64 arrays `time_s` and
/// `displacement_m`, as a dictionary or a pair, and each row is then a `dashpot.RecordedError`. Ctrl-C cancels between
/// two steps.
///
/// >>> import dashpot, numpy
/// >>> time_s = numpy.arange(500) * 1e-3
/// >>> x = 5e-3 * numpy.sin(20 * time_s)
/// >>> rows = dashpot.verify(dashpot.Damper("paper"), (time_s, x), step_s=[1e-3])
/// >>> [(row.scalar, row.nrmse < 0.01) for row in rows]
/// [('f32', True), ('f64', True)]
#[pyfunction]
#[pyo3(signature = (
    damper, recording=None, *, step_s=None, top_speed_m_per_s=None
))]
pub fn verify<'py>(
    py: Python<'py>,
    damper: &Bound<'py, Damper>,
    recording: Option<&Bound<'py, PyAny>>,
    step_s: Option<&Bound<'py, PyAny>>,
    top_speed_m_per_s: Option<f64>,
) -> Outcome<Bound<'py, PyList>> {
    let parameters = &damper.get().parameters;
    let steps_s = |default: &[f64]| steps_s(step_s, default);
    match recording {
        None => {
            let limit = parameters.limits.rate_m_per_s;
            if let Some(speed) =
                top_speed_m_per_s.filter(|speed| !(0.0 < *speed && *speed <= limit))
            {
                return refuse(format!(
                    "top_speed_m_per_s: {speed}, allowed: above 0 and at most limits.rate_m_per_s = {limit} m/s"
                ));
            }
            let rows = |step_s| {
                let errors = StepErrors::new(parameters, step_s, top_speed_m_per_s)?;
                errors.rows(dashpot_workers::threads())
            };
            rows_of(py, &STEP_ERROR, &steps_s(&[1e-3, 1e-4])?, rows)
        }
        Some(recording) => {
            if top_speed_m_per_s.is_some() {
                return refuse("top_speed_m_per_s: allowed only without a recording");
            }
            let samples = samples(recording)?;
            let rows = |step_s| {
                let shared = Rc::new(samples.clone());
                let recording = Recording::from_samples(Path::new("recording"), shared);
                on_recording(parameters, recording, &samples, step_s)
            };
            rows_of(py, &RECORDED_ERROR, &steps_s(&[1e-3, 5e-4, 1e-4])?, rows)
        }
    }
}

/// A number or a sequence of steps.
fn steps_s(given: Option<&Bound<'_, PyAny>>, default: &[f64]) -> Outcome<Vec<f64>> {
    let steps_s = match given {
        None => default.to_vec(),
        Some(given) => match given.extract::<f64>() {
            Ok(one) => vec![one],
            Err(_) => given.extract()?,
        },
    };
    for step_s in &steps_s {
        check_step(*step_s)?;
    }
    Ok(steps_s)
}

fn samples(recording: &Bound<'_, PyAny>) -> Outcome<Vec<Sample>> {
    let [times_s, displacements_m] = arrays_of(recording, ["time_s", "displacement_m"])?;
    if times_s.len() != displacements_m.len() {
        return refuse(format!(
            "{} times and {} displacements, allowed: the same number of each",
            times_s.len(),
            displacements_m.len()
        ));
    }
    let pairs = times_s.into_iter().zip(displacements_m);
    let samples = pairs.map(|(time_s, displacement_m)| Sample {
        time_s,
        displacement_m,
    });
    Ok(samples.collect())
}

/// Computes two rows for each step, as objects of `class`.
fn rows_of<'py, R: Serialize + Send>(
    py: Python<'py>,
    class: &Class,
    steps_s: &[f64],
    rows: impl Fn(f64) -> Result<[R; 2], TestbenchError> + Send + Sync,
) -> Outcome<Bound<'py, PyList>> {
    let work = |is_unwanted: &(dyn Fn() -> bool + Sync)| {
        let mut all = Vec::new();
        for step_s in steps_s.iter().take_while(|_| !is_unwanted()) {
            all.extend(rows(*step_s)?);
        }
        Ok::<_, Refusal>(all)
    };
    let found = py.detach(|| run_in_thread(work))??;
    let list = PyList::empty(py);
    for row in &found {
        let row = json::report(py, row)?;
        let Ok(row) = row.cast::<PyDict>() else {
            return refuse("a row of errors is not a table");
        };
        for name in ["nrmse_motion", "largest_error_motion"] {
            if let Some(motion) = row.get_item(name)? {
                let (kind, speed) = (motion.get_item("kind")?, motion.get_item("speed_m_per_s")?);
                row.set_item(name, (kind, speed))?;
            }
        }
        list.append(class.make_of(row)?)?;
    }
    Ok(list)
}
