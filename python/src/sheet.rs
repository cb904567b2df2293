//! Acceptance sheets from recordings of a bench.

use std::path::PathBuf;

use dashpot_files::sheet::SheetParameters;
use dashpot_report::sheet::{Line, SheetInput, SheetReport, TestReport, measured};
use dashpot_testbench::steady::SensorUncertainty;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::calibration_request::temperatures_c;
use crate::class::Class;
use crate::error::{Outcome, Refusal, refuse};
use crate::json;
use crate::overrides::{path, path_of_file};
use crate::range::within;
use crate::recording::channels;

const MODULE: &str = "dashpot._sheet";
static SHEET: Class = Class::new(MODULE, "Sheet");
static TEST: Class = Class::new(MODULE, "SheetTest");

/// Computes an acceptance sheet from recordings of a bench, as `dashpot sheet`: indices with uncertainties, limits and
/// the verdict.
///
/// `sheet` is built in or a file. `recordings` is a file or a sequence of files, and `temperature_c` the oil's
/// temperature in them (degrees Celsius): a number, or a sequence with one for each. The uncertainties are those of the
/// calibration of the sensors, in per cent of the value (half of a 95 % interval). Serial number, operator and date are
/// for the header. The other arguments are those of `dashpot.read`. A sheet that is not passed is returned like any
/// other: see its `verdict`.
///
/// >>> import dashpot
/// >>> try:
/// ...     dashpot.sheet("example", "nowhere.csv")
/// ... except dashpot.DashpotFileError as error:
/// ...     print(error.filename)
/// nowhere.csv
#[pyfunction]
#[pyo3(signature = (
    sheet, recordings, *, temperature_c=None, force_uncertainty_percent=0.0, displacement_uncertainty_percent=0.0,
    serial_number=None, operator=None, date=None, time=None, displacement=None, force=None, time_unit=None,
    displacement_unit=None, force_unit=None, group=None, skip_invalid=false, header=None, decimal_mark=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn sheet<'py>(
    py: Python<'py>,
    sheet: &Bound<'py, PyAny>,
    recordings: &Bound<'py, PyAny>,
    temperature_c: Option<&Bound<'py, PyAny>>,
    force_uncertainty_percent: f64,
    displacement_uncertainty_percent: f64,
    serial_number: Option<String>,
    operator: Option<String>,
    date: Option<String>,
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
    let names = [time, displacement, force];
    let units = [time_unit, displacement_unit, force_unit];
    let channels = channels(names, units, group, skip_invalid, header, decimal_mark)?;
    let parameters = SheetParameters::load(&path(sheet)?)?;
    let files = files(recordings)?;
    let temperatures_c = temperatures_c(temperature_c, files.len())?;
    let share = |name, percent| Ok::<_, Refusal>(0.01 * within(name, percent, [0.0, 100.0])?);
    let sensors = SensorUncertainty {
        force: share("force_uncertainty_percent", force_uncertainty_percent)?,
        displacement: share(
            "displacement_uncertainty_percent",
            displacement_uncertainty_percent,
        )?,
    };
    let fields = [
        ("Serial number", serial_number),
        ("Date of the test", date),
        ("Operator", operator),
    ];
    let (report, page) = py.detach(|| {
        let inputs = files.iter().zip(temperatures_c);
        let inputs = inputs
            .map(|(file, temperature_c)| SheetInput::read(file, &channels, temperature_c))
            .collect::<Result<Vec<_>, _>>()?;
        let report = measured(&parameters, inputs, sensors);
        let mut report = report
            .map_err(|error| Refusal::Value(format!("{error}; give it with temperature_c")))?;
        for (name, text) in fields {
            let name = name.to_owned();
            report.fields.extend(text.map(|text| Line { name, text }));
        }
        let page = report.to_html();
        let page = page.map_err(|error| Refusal::Value(error.to_string()))?;
        Ok::<_, Refusal>((report, page))
    })?;
    in_python(py, &report, &page)
}

/// A file, or a sequence of files.
fn files(recordings: &Bound<'_, PyAny>) -> Outcome<Vec<PathBuf>> {
    let is_one = recordings.extract::<String>().is_ok() || recordings.hasattr("__fspath__")?;
    if is_one {
        return Ok(vec![path_of_file(recordings)?]);
    }
    let mut files = Vec::new();
    for file in recordings.try_iter()? {
        files.push(path_of_file(&file?)?);
    }
    match files.is_empty() {
        true => refuse("recordings: empty, allowed: at least one file"),
        false => Ok(files),
    }
}

fn in_python<'py>(py: Python<'py>, report: &SheetReport, page: &str) -> Outcome<Bound<'py, PyAny>> {
    let (fields, tests) = (PyDict::new(py), PyList::empty(py));
    for Line { name, text } in &report.fields {
        fields.set_item(name, text)?;
    }
    for test in &report.tests {
        tests.append(test_in_python(py, test)?)?;
    }
    let mut text = Vec::new();
    if let Err(error) = SheetReport::print(&mut text, report) {
        return refuse(error);
    }
    let found = PyDict::new(py);
    found.set_item("title", &report.title)?;
    found.set_item("sheet", &report.sheet)?;
    found.set_item("fields", fields)?;
    found.set_item("verdict", json::report(py, &report.verdict)?)?;
    found.set_item("is_good", report.verdict.is_good())?;
    found.set_item("limits", report.limits)?;
    found.set_item("limits_not_kept", report.limits_not_kept)?;
    found.set_item("warnings", &report.warnings)?;
    found.set_item("tests", tests)?;
    let origin = json::report(py, &report.origin)?;
    for name in ["recordings", "missing", "other_motions", "unused_cycles"] {
        found.set_item(name, origin.get_item(name)?)?;
    }
    found.set_item("text", String::from_utf8_lossy(&text))?;
    found.set_item("page", page)?;
    SHEET.make_of(&found)
}

fn test_in_python<'py>(py: Python<'py>, test: &TestReport) -> Outcome<Bound<'py, PyAny>> {
    let found = PyDict::new(py);
    let report = json::report(py, test)?;
    let names = [
        "name",
        "amplitude_m",
        "frequency_hz",
        "peak_velocity_m_per_s",
        "temperature_c",
        "step_s",
        "cycles",
        "indices",
        "limits",
        "recording",
        "start_s",
        "end_s",
        "unsteady_cycles",
        "distortion",
        "force_change",
        "half_widths",
    ];
    for name in names {
        found.set_item(name, report.get_item(name)?)?;
    }
    let cycle = &test.cycle;
    let arrays = [
        (
            "displacement_m",
            PyArray1::from_slice(py, &cycle.displacements_m),
        ),
        (
            "velocity_m_per_s",
            PyArray1::from_vec(py, cycle.velocities_m_per_s()),
        ),
        ("force_n", PyArray1::from_slice(py, &cycle.forces_n)),
    ];
    for (name, array) in arrays {
        found.set_item(name, array)?;
    }
    TEST.make_of(&found)
}
