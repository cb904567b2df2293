//! Trends of the dampers of a fleet.

use dashpot_testbench::health::Noise;
use dashpot_testbench::trend::limits::Limits;
use dashpot_testbench::trend::reading::Estimation;
use dashpot_testbench::trend::recordings::list;
use dashpot_testbench::trend::rows::csv;
use dashpot_testbench::trend::{Axis, Fleet, Summary, series};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;

use crate::class::Class;
use crate::damper::Damper;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_in_thread;
use crate::overrides::path_of_file;
use crate::range::check_step;
use crate::recording::channels;
use crate::sensors::{Sensors, model};
use crate::table::columns;

static FLEET: Class = Class::new("dashpot._fleet", "Fleet");

/// Noise for checking the other settings where it is estimated from each recording.
const ANY_NOISE: Noise = Noise {
    displacement_m: 1e-5,
    force_n: 1.0,
};

/// Estimates trends of a fleet's dampers over months of recordings, as `dashpot health`: rates of change, and when
/// limits are reached.
///
/// The file recordings.csv in `folder` lists the recordings; without it, files must be named
/// VEHICLE/DAMPER/DATE.EXTENSION. `damper` is the model of recordings that name none. `mileage` uses the mileage
/// instead of the date. The limits are the lowest damping relative to nominal, the lowest stiffness and the highest
/// clearance, by default those of the kind of damper. `accept_several_changed` uses readings of which several
/// parameters have changed together. The other arguments are those of `dashpot.health` and `dashpot.read`. Ctrl-C
/// cancels the estimate.
///
/// >>> import dashpot, tempfile
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     try:
/// ...         dashpot.fleet(folder, dashpot.Damper("in-service"))
/// ...     except dashpot.DashpotError as error:
/// ...         print("no recording" in str(error))
/// True
#[pyfunction]
#[pyo3(signature = (
    folder, damper, *, mileage=false, limit_damping_factor=None, limit_stiffness_n_per_m=None, limit_clearance_m=None,
    accept_several_changed=false, step_s=0.001, displacement_noise_m=None, force_noise_n=None, memory_s=None,
    law_deviation=None, lag_s=None, lag_sd_s=None, time=None, displacement=None, force=None, time_unit=None,
    displacement_unit=None, force_unit=None, group=None, skip_invalid=false, header=None, decimal_mark=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn fleet<'py>(
    py: Python<'py>,
    folder: &Bound<'py, PyAny>,
    damper: &Bound<'py, Damper>,
    mileage: bool,
    limit_damping_factor: Option<f64>,
    limit_stiffness_n_per_m: Option<f64>,
    limit_clearance_m: Option<f64>,
    accept_several_changed: bool,
    step_s: f64,
    displacement_noise_m: Option<f64>,
    force_noise_n: Option<f64>,
    memory_s: Option<f64>,
    law_deviation: Option<f64>,
    lag_s: Option<f64>,
    lag_sd_s: Option<f64>,
    time: Option<String>,
    displacement: Option<String>,
    force: Option<String>,
    time_unit: Option<&str>,
    displacement_unit: Option<&str>,
    force_unit: Option<&str>,
    group: Option<String>,
    skip_invalid: bool,
    header: Option<bool>,
    decimal_mark: Option<&str>,
) -> Outcome<Bound<'py, PyAny>> {
    check_step(step_s)?;
    let limits = Limits {
        damping_factor: positive("limit_damping_factor", limit_damping_factor)?,
        stiffness_n_per_m: positive("limit_stiffness_n_per_m", limit_stiffness_n_per_m)?,
        clearance_m: positive("limit_clearance_m", limit_clearance_m)?,
    };
    let sensors = Sensors {
        displacement_noise_m,
        force_noise_n,
        memory_s,
        law_deviation,
        lag_s,
        lag_sd_s,
    };
    let names = [time, displacement, force];
    let units = [time_unit, displacement_unit, force_unit];
    let damper = damper.get();
    let estimation = Estimation {
        damper: damper.name.clone(),
        parameters: damper.parameters.clone(),
        channels: channels(names, units, group, skip_invalid, header, decimal_mark)?,
        step_s,
        settings: sensors.settings(ANY_NOISE),
        estimates_displacement_noise: displacement_noise_m.is_none(),
        estimates_force_noise: force_noise_n.is_none(),
        accepts_several_changed: accept_several_changed,
    };
    model(&damper.parameters, &estimation.settings, step_s)?;
    let axis = match mileage {
        true => Axis::Mileage,
        false => Axis::Date,
    };
    let folder = path_of_file(folder)?;
    let work = |is_unwanted: &(dyn Fn() -> bool + Sync)| {
        let (placed, unplaced) = series::series(list(&folder)?, axis);
        let threads = dashpot_workers::threads();
        let recorded =
            series::estimate_cancellable(&placed, &estimation, threads, |_| {}, is_unwanted);
        // A cancelled series may be without a reading.
        match is_unwanted() {
            true => Ok(None),
            false => Ok(Some(Fleet::assess(
                axis, &placed, recorded, unplaced, &limits,
            ))),
        }
    };
    match py.detach(|| run_in_thread(work))? {
        Ok(Some(fleet)) => in_python(py, &fleet),
        Ok(None) => refuse("interrupted"),
        Err(error) => Err::<_, Refusal>(error),
    }
}

/// Checks a limit.
fn positive(name: &str, limit: Option<f64>) -> Outcome<Option<f64>> {
    match limit {
        Some(limit) if !(limit.is_finite() && limit > 0.0) => {
            refuse(format!("{name}: {limit}, allowed: a number above 0"))
        }
        limit => Ok(limit),
    }
}

fn in_python<'py>(py: Python<'py>, fleet: &Fleet) -> Outcome<Bound<'py, PyAny>> {
    let summary = Summary::new(fleet);
    let found = PyDict::new(py);
    found.set_item("vehicles", summary.vehicles)?;
    found.set_item("dampers", summary.dampers)?;
    found.set_item("recordings", summary.recordings)?;
    found.set_item("recordings_used", summary.recordings_used)?;
    found.set_item("recordings_unreadable", summary.recordings_unreadable)?;
    found.set_item("trends", table(py, &summary.trends)?)?;
    found.set_item("readings", table(py, &fleet.reading_rows())?)?;
    found.set_item("text", summary.text())?;
    FLEET.make_of(&found)
}

/// Columns with the names and the order of the command's CSV.
fn table<'py>(py: Python<'py>, rows: &[impl Serialize]) -> Outcome<Bound<'py, PyDict>> {
    let text = match csv(rows) {
        Ok(text) => String::from_utf8_lossy(&text).into_owned(),
        Err(error) => return refuse(error),
    };
    let names: Vec<&str> = text.lines().next().unwrap_or_default().split(',').collect();
    columns(py, &names, rows)
}
