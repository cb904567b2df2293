//! A vehicle that runs along a track.

use std::sync::LazyLock;

use dashpot_files::case::{CASES, Case, CaseNumbers, CaseOptions, CaseParts};
use dashpot_study::sweep::Shared;
use dashpot_vehicle_run::Ending;
use dashpot_vehicle_run::recorded::{Recorded, record};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::contact_table::contact_assignments;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::Interruption;
use crate::json;
use crate::overrides::{assignments, path};
use crate::replacements::replacements;

/// Contacts and tracks, each built once per process.
pub static SHARED: LazyLock<Shared> = LazyLock::new(Shared::default);

/// A run of a vehicle. `dashpot.vehicle` returns it.
///
/// >>> import dashpot
/// >>> run = dashpot.vehicle("straight-180", duration_s=0.1, signals=["time_s", "body_vertical_m"])
/// >>> run
/// <VehicleRun 'straight, 180 km/h', completed>
#[pyclass(module = "dashpot", frozen)]
pub struct VehicleRun {
    case: String,
    step_s: f64,
    ending: Ending,
    history: Py<PyDict>,
    indices: Py<PyAny>,
    warnings: Vec<String>,
}

#[pymethods]
impl VehicleRun {
    /// Name of the case.
    #[getter]
    fn case(&self) -> &str {
        &self.case
    }

    /// Step (s).
    #[getter]
    fn step_s(&self) -> f64 {
        self.step_s
    }

    /// How the run ended, in words: `completed`, or when and where the vehicle derailed, overturned, diverged, left the
    /// contact tables or went beyond the model (a wheel load over 50 times the static load).
    #[getter]
    fn ending(&self) -> String {
        self.ending.to_string()
    }

    /// True if the run completed.
    #[getter]
    fn is_completed(&self) -> bool {
        self.ending == Ending::Completed
    }

    /// Arrays of the signals by name, one value per tick, as `pandas.DataFrame` accepts them. The command writes the
    /// same values to history.csv.
    #[getter]
    fn history(&self, py: Python<'_>) -> Py<PyDict> {
        self.history.clone_ref(py)
    }

    /// Results outside the model's validity, one sentence each with time and position: wheel loads over 10 times the
    /// static load, and wheels without load for more than 50 ms. Empty if there is nothing to warn about.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// The indices, as in the command's indices.json; `None` for a run that derailed, overturned, diverged, left the
    /// contact tables or went beyond the model.
    #[getter]
    fn indices(&self, py: Python<'_>) -> Py<PyAny> {
        self.indices.clone_ref(py)
    }

    fn __repr__(&self) -> String {
        let warnings = match self.warnings.len() {
            0 => String::new(),
            1 => ", 1 warning".to_owned(),
            count => format!(", {count} warnings"),
        };
        format!("<VehicleRun '{}', {}{warnings}>", self.case, self.ending)
    }
}

/// Runs a vehicle along a track. Give a case (a shipped one or a TOML file), whose values the other arguments override,
/// or a track and a speed.
///
/// `contact` is a dictionary with keys of the table `[contact]` of a case file: profiles, gauge, inclination and
/// friction. File names in it are relative to the working directory.
///
/// `dampers` is a dictionary from dampers, by direction or name, to their replacements: a preset, a file or a `Damper`.
/// `overrides` changes values of the vehicle. Both work like the command's `--damper` and `--set`. `signals` selects
/// the signals of the history; default: all. Ctrl-C cancels the run.
///
/// >>> import dashpot
/// >>> run = dashpot.vehicle("straight-180", duration_s=0.5, dampers={"vertical": "in-service"})
/// >>> run.history["time_s"][-1]
/// np.float64(0.5)
/// >>> sorted(run.indices)[:2]
/// ['bodies', 'duration_s']
/// >>> contact = {"rail_inclination": 0.05, "friction_over_distance": [[0, 0.4, 0.4], [20, 0.4, 0.2]]}
/// >>> dashpot.vehicle("straight-180", duration_s=0.1, contact=contact).is_completed
/// True
#[pyfunction]
#[pyo3(signature = (
    case=None, *, vehicle=None, track=None, speed_km_h=None, duration_s=None, start_m=None, friction=None,
    normal_damping_s_per_m=None, step_us=None, push_m=None, contact=None, dampers=None, overrides=None, signals=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn vehicle(
    py: Python<'_>,
    case: Option<&Bound<'_, PyAny>>,
    vehicle: Option<&Bound<'_, PyAny>>,
    track: Option<&Bound<'_, PyAny>>,
    speed_km_h: Option<f64>,
    duration_s: Option<f64>,
    start_m: Option<f64>,
    friction: Option<f64>,
    normal_damping_s_per_m: Option<f64>,
    step_us: Option<f64>,
    push_m: Option<f64>,
    contact: Option<&Bound<'_, PyAny>>,
    dampers: Option<&Bound<'_, PyAny>>,
    overrides: Option<&Bound<'_, PyAny>>,
    signals: Option<Vec<String>>,
) -> Outcome<VehicleRun> {
    let name = |given: Option<&Bound<'_, PyAny>>| given.map(path).transpose();
    let (case, vehicle, track) = (name(case)?, name(vehicle)?, name(track)?);
    let parts = CaseParts {
        case: case.as_deref(),
        vehicle: vehicle.as_deref(),
        track: track.as_deref(),
        numbers: CaseNumbers {
            speed_km_h,
            duration_s,
            start_m,
            friction,
            normal_damping_s_per_m,
            step_us,
            push_m,
        },
    };
    let Some(mut options) = parts.options()? else {
        let names = CASES.map(|(name, _)| name).join(", ");
        return refuse(format!(
            "no case: give case ({names}), or track with speed_km_h"
        ));
    };
    options.dampers.extend(replacements(dampers)?);
    options.overrides.extend(contact_assignments(contact)?);
    options.overrides.extend(assignments(overrides)?);
    run(py, &options, signals.as_deref())
}

fn run(py: Python<'_>, options: &CaseOptions, signals: Option<&[String]>) -> Outcome<VehicleRun> {
    let (case, recorded) = py.detach(|| {
        let case: Case = options.case()?;
        let interruption = Interruption::default();
        let run = SHARED.run(&case);
        let recorded = run
            .and_then(|run| record(&case, run, signals, &|| interruption.is_requested()))
            .map_err(|error| Refusal::of_case(&case.name, error));
        interruption.raised()?;
        Ok::<_, Refusal>((case, recorded?))
    })?;
    let Recorded {
        ending,
        history: recorded,
        indices,
        warnings,
    } = recorded;
    let history = PyDict::new(py);
    for (name, column) in recorded {
        history.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok(VehicleRun {
        case: case.name,
        step_s: case.step_s,
        ending,
        history: history.unbind(),
        indices: json::report(py, &indices)?.unbind(),
        warnings: warnings.iter().map(ToString::to_string).collect(),
    })
}
