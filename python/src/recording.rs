//! Recordings from files as arrays.

use std::path::Path;

use dashpot_core::parameters::STEP_RANGE_S;
use dashpot_hil::files::recording::{
    Channel, Channels, DecimalMark, Measurement, Quantity, Recording, TextOptions,
};
use dashpot_hil::study::StudyError;
use dashpot_hil::study::tick_grid::{TickGrid, nearest_nanosecond};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{Outcome, refuse};
use crate::overrides::path_of_file;

/// Reads a recording, CSV, MDF4 or Parquet: arrays `time_s` and `displacement_m`, and `force_n` where `with_force`.
///
/// With `step_s` (s) it is read on the ticks of that step, linear between samples, as `dashpot replay` does. `time`, `displacement` and `force`
/// name the channels, `time_unit`, `displacement_unit` and `force_unit` their units, where the file does not tell; `group` is one of an MDF4 file,
/// `header` says whether the first row of text has names, `decimal_mark` whether numbers have a `point` or a `comma`. `skip_invalid` leaves out rows
/// that lack a value.
///
/// >>> import dashpot, pathlib, tempfile
/// >>> with tempfile.TemporaryDirectory() as folder:
/// ...     file = pathlib.Path(folder, "run7.csv")
/// ...     _ = file.write_text("Zeit [s];Weg [mm]\n0;0\n0,01;2\n0,02;3\n")
/// ...     motion = dashpot.read(file, step_s=5e-3, time="Zeit", displacement="Weg")
/// >>> motion["displacement_m"].tolist()
/// [0.0, 0.001, 0.002, 0.0025, 0.003]
#[pyfunction]
#[pyo3(signature = (
    path, *, step_s=None, with_force=false, time=None, displacement=None, force=None, time_unit=None,
    displacement_unit=None, force_unit=None, group=None, skip_invalid=false, header=None, decimal_mark=None
))]
#[expect(clippy::too_many_arguments, reason = "what Python names when it calls")]
pub fn read<'py>(
    py: Python<'py>,
    path: &Bound<'py, PyAny>,
    step_s: Option<f64>,
    with_force: bool,
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
) -> Outcome<Bound<'py, PyDict>> {
    let channels = Channels {
        time: channel(Quantity::Time, time, time_unit)?,
        displacement: channel(Quantity::Displacement, displacement, displacement_unit)?,
        force: channel(Quantity::Force, force, force_unit)?,
        group,
        skip_invalid,
        text: TextOptions {
            header,
            decimal_mark: decimal_mark.map(mark).transpose()?,
            ..TextOptions::default()
        },
    };
    let path = path_of_file(path)?;
    let path = path.as_path();
    if step_s.is_some() && with_force {
        return refuse("step_s with with_force: allowed: one of them");
    }
    let columns = py.detach(|| columns(path, &channels, step_s, with_force));
    let columns = columns.map_err(|refusal| refusal.with(|words| in_arguments(path, words)))?;
    let arrays = PyDict::new(py);
    for (name, column) in columns {
        arrays.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok(arrays)
}

/// Names of columns and their numbers.
type Columns = Vec<(&'static str, Vec<f64>)>;

fn columns(
    path: &Path,
    channels: &Channels,
    step_s: Option<f64>,
    with_force: bool,
) -> Outcome<Columns> {
    if with_force {
        let samples = Measurement::open(path, channels)?.read_all()?;
        let column = |of: fn(&_) -> f64| samples.iter().map(of).collect();
        return Ok(vec![
            ("time_s", column(|sample| sample.time_s)),
            ("displacement_m", column(|sample| sample.displacement_m)),
            ("force_n", column(|sample| sample.force_n)),
        ]);
    }
    let recording = || Recording::open_with(path, channels);
    let (times, displacements): (Vec<f64>, Vec<f64>) = match step_s {
        Some(step_s) if !STEP_RANGE_S.contains(&step_s) => {
            return Err(StudyError::Step { step_s }.into());
        }
        Some(step_s) => {
            let ticks = TickGrid::new(recording()?, step_s)?.read_all()?;
            let ticks = ticks
                .iter()
                .map(|tick| (nearest_nanosecond(tick.time_s), tick.displacement_m));
            ticks.unzip()
        }
        None => {
            let samples = recording()?.read_all()?;
            samples
                .iter()
                .map(|sample| (sample.time_s, sample.displacement_m))
                .unzip()
        }
    };
    Ok(vec![("time_s", times), ("displacement_m", displacements)])
}

/// Options of the command that the library's words name, and the arguments of `read` that they are here.
const ARGUMENTS: [(&str, &str); 13] = [
    ("--header yes or --header no", "header=True or header=False"),
    ("--decimal-mark", "decimal_mark"),
    ("--skip-invalid", "skip_invalid=True"),
    ("--group", "group"),
    ("--time-unit", "time_unit"),
    ("--time NAME", "time=NAME"),
    ("--time", "time"),
    ("--displacement-unit", "displacement_unit"),
    ("--displacement NAME", "displacement=NAME"),
    ("--displacement", "displacement"),
    ("--force-unit", "force_unit"),
    ("--force NAME", "force=NAME"),
    ("--force", "force"),
];

/// What the library says of a file, with Python's arguments in place of the command's options; what the file itself says stays.
fn in_arguments(path: &Path, words: &str) -> String {
    let file = path.display().to_string();
    let (file, reason) = match words.strip_prefix(&file) {
        Some(reason) => (file.as_str(), reason),
        None => ("", words),
    };
    // Every second part is a name or a cell of the file, in quotes.
    let parts = reason.split('`').enumerate().map(|(number, part)| {
        let translated =
            |part: String, (option, argument): &(&str, &str)| part.replace(option, argument);
        match number.is_multiple_of(2) {
            true => ARGUMENTS.iter().fold(part.to_owned(), translated),
            false => part.to_owned(),
        }
    });
    format!("{file}{}", parts.collect::<Vec<_>>().join("`"))
}

/// A decimal mark by its name or itself.
fn mark(text: &str) -> Outcome<DecimalMark> {
    match text {
        "." | "point" => Ok(DecimalMark::Point),
        "," | "comma" => Ok(DecimalMark::Comma),
        other => refuse(format!(
            "decimal_mark: `{other}`, allowed: `point` or `comma`"
        )),
    }
}

/// A channel by its name and unit.
fn channel(quantity: Quantity, name: Option<String>, unit: Option<&str>) -> Outcome<Channel> {
    let unit = match unit.map(|text| (text, quantity.unit(text))) {
        Some((text, None)) => {
            return refuse(format!("unit `{text}`, allowed: {}", quantity.unit_names()));
        }
        Some((_, unit)) => unit,
        None => None,
    };
    Ok(Channel {
        name,
        unit,
        reversed: false,
    })
}
