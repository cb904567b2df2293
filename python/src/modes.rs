//! Natural modes of a vehicle.

use dashpot_files::contact::{ContactOptions, apply_overrides};
use dashpot_study::modes::{ModesError, ModesReport, ModesRequest, modes as modes_of};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::class::Class;
use crate::contact_table::contact_assignments;
use crate::error::{Outcome, Refusal, refuse};
use crate::overrides::{assignments, path};
use crate::replacements::replacements;
use crate::table::columns;

static MODES: Class = Class::new("dashpot._modes", "Modes");

/// Computes axle loads and natural modes of a vehicle at standstill or at a speed, as `dashpot modes`: frequency,
/// damping and what moves.
///
/// `vehicle` is built in or a file; `dampers`, `overrides` and `contact` are those of `dashpot.vehicle`. With `hunting`
/// the critical speeds are searched for, and the modes are those at the linear one. With `sliding` the friction
/// elements slide and have no part in a mode; otherwise they stick.
///
/// >>> import dashpot
/// >>> found = dashpot.modes("locomotive", speed_km_h=180)
/// >>> found.modes["mode"][1], round(float(found.modes["undamped_hz"][1]), 2)
/// ('body bounce', 1.79)
#[pyfunction]
#[pyo3(signature = (
    vehicle, *, speed_km_h=None, hunting=false, sliding=false, friction=0.4, dampers=None, overrides=None, contact=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn modes<'py>(
    py: Python<'py>,
    vehicle: &Bound<'py, PyAny>,
    speed_km_h: Option<f64>,
    hunting: bool,
    sliding: bool,
    friction: f64,
    dampers: Option<&Bound<'py, PyAny>>,
    overrides: Option<&Bound<'py, PyAny>>,
    contact: Option<&Bound<'py, PyAny>>,
) -> Outcome<Bound<'py, PyAny>> {
    if hunting && speed_km_h.is_some() {
        return refuse("hunting and speed_km_h: both given, allowed: only one of them");
    }
    let mut of_contact = ContactOptions::default();
    if let Err((assignment, reason)) =
        apply_overrides(&mut of_contact, &contact_assignments(contact)?)
    {
        return Err(ModesError::Override { assignment, reason }.into());
    }
    let request = ModesRequest {
        replacements: replacements(dampers)?,
        overrides: assignments(overrides)?,
        contact: of_contact,
        speed_km_h,
        hunting,
        sliding,
        friction,
        ..ModesRequest::of(&path(vehicle)?)
    };
    let report = py.detach(|| modes_of(&request).map_err(Refusal::from))?;
    in_python(py, &report)
}

impl From<ModesError> for Refusal {
    fn from(error: ModesError) -> Self {
        match error {
            ModesError::File(error) => error.into(),
            other => Self::Value(other.to_string()),
        }
    }
}

fn in_python<'py>(py: Python<'py>, report: &ModesReport) -> Outcome<Bound<'py, PyAny>> {
    let found = PyDict::new(py);
    found.set_item("vehicle", &report.vehicle)?;
    found.set_item(
        "axle_loads_n",
        PyArray1::from_slice(py, &report.axle_loads_n),
    )?;
    found.set_item("speed_km_h", report.speed_km_h)?;
    let hunting = report.hunting.as_ref();
    let speeds = [
        (
            "critical_speed_km_h",
            hunting.and_then(|found| found.critical_speed_km_h),
        ),
        (
            "nonlinear_critical_speed_km_h",
            hunting.and_then(|found| found.nonlinear_critical_speed_km_h),
        ),
        (
            "limit_cycle_m",
            hunting.and_then(|found| found.limit_cycle_m),
        ),
    ];
    for (name, value) in speeds {
        found.set_item(name, value)?;
    }
    let friction = report.dry_friction.as_ref();
    let friction = friction.map_or(0, |friction| friction.elements);
    found.set_item("friction_elements", friction)?;
    let names = ["mode", "undamped_hz", "damped_hz", "damping_ratio"];
    found.set_item("modes", columns(py, &names, &report.modes)?)?;
    MODES.make_of(&found)
}
