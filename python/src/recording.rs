//! Reads recordings from files into arrays.

use std::path::Path;

use dashpot_files::nearest_nanosecond;
use dashpot_recording::tick_grid::TickGrid;
use dashpot_recording::{
    Channel, Channels, DecimalMark, Gaps, Measurement, Quantity, Recording, Sample, TextOptions,
};
use numpy::{Ix1, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};

use crate::arrays::read as read_array;
use crate::error::{Outcome, refuse};
use crate::overrides::path_of_file;
use crate::range::check_step;

/// Reads a CSV, MDF4 or Parquet recording into the arrays `time_s` and `displacement_m`, and `force_n` if `with_force`
/// is true.
///
/// With `step_s` (s) the recording is resampled at the ticks of that step, linearly between samples, as in `dashpot
/// replay`. `time`, `displacement` and `force` name the channels; `time_unit`, `displacement_unit` and `force_unit`
/// give their units if the file does not. `group` selects a group of an MDF4 file, `header` states whether the first
/// row of a text file contains names, and `decimal_mark` is `point` or `comma`. `skip_invalid` skips rows that lack a
/// value. A text file whose last line has no line end may be truncated within a number; it is read with a
/// `UserWarning`.
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
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
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
    let names = [time, displacement, force];
    let units = [time_unit, displacement_unit, force_unit];
    let channels = channels(names, units, group, skip_invalid, header, decimal_mark)?;
    let path = path_of_file(path)?;
    let path = path.as_path();
    if step_s.is_some() && with_force {
        return refuse("step_s and with_force: both given, allowed: only one of them");
    }
    let (columns, gaps) = py.detach(|| columns(path, &channels, step_s, with_force))?;
    if let Some(line) = gaps.unended_line {
        warn_of_unended(py, path, line)?;
    }
    if gaps.unfinished.is_some() {
        warn_of_unfinished(py, path)?;
    }
    let arrays = PyDict::new(py);
    for (name, column) in columns {
        arrays.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok(arrays)
}

/// Warns that the file may be truncated within the last number of its last line.
fn warn_of_unended(py: Python<'_>, path: &Path, line: u64) -> Outcome<()> {
    let words = format!(
        "{}:{line}: the last line has no line end: the file may have been cut off inside the last number of that line",
        path.display()
    );
    py.import("warnings")?.call_method1("warn", (words,))?;
    Ok(())
}

/// Warns that the logger did not finish an MDF4 file.
fn warn_of_unfinished(py: Python<'_>, path: &Path) -> Outcome<()> {
    let words = format!(
        "{}: the logger did not finish this MDF4 file: rows are read up to the last whole one",
        path.display()
    );
    py.import("warnings")?.call_method1("warn", (words,))?;
    Ok(())
}

/// Column names and values.
type Columns = Vec<(&'static str, Vec<f64>)>;

fn columns(
    path: &Path,
    channels: &Channels,
    step_s: Option<f64>,
    with_force: bool,
) -> Outcome<(Columns, Gaps)> {
    if with_force {
        let mut measurement = Measurement::open(path, channels)?;
        let samples = measurement.read_all()?;
        let column = |get: fn(&_) -> f64| samples.iter().map(get).collect();
        let columns = vec![
            ("time_s", column(|sample| sample.time_s)),
            ("displacement_m", column(|sample| sample.displacement_m)),
            ("force_n", column(|sample| sample.force_n)),
        ];
        return Ok((columns, measurement.gaps()));
    }
    let recording = || Recording::open_with(path, channels);
    let ((times, displacements), gaps): ((Vec<f64>, Vec<f64>), Gaps) = match step_s {
        Some(step_s) => {
            check_step(step_s)?;
            let mut grid = TickGrid::new(recording()?, step_s)?;
            let mut ticks = Vec::new();
            while let Some(tick) = grid.next_tick()? {
                ticks.push((nearest_nanosecond(tick.time_s), tick.displacement_m));
            }
            (ticks.into_iter().unzip(), grid.recording().gaps())
        }
        None => {
            let mut recording = recording()?;
            let samples = recording.read_all()?;
            let pair = |sample: &Sample| (sample.time_s, sample.displacement_m);
            (samples.iter().map(pair).unzip(), recording.gaps())
        }
    };
    let columns = vec![("time_s", times), ("displacement_m", displacements)];
    Ok((columns, gaps))
}

/// Numbers of a recording: a mapping with arrays of these names, as `read` returns it, or a sequence of arrays in their
/// order.
pub fn arrays_of<const N: usize>(
    recording: &Bound<'_, PyAny>,
    names: [&str; N],
) -> Outcome<[Vec<f64>; N]> {
    let is_mapping = recording.cast::<PyMapping>().is_ok();
    let listed = match is_mapping {
        true => Vec::new(),
        false => recording.try_iter()?.collect::<PyResult<Vec<_>>>()?,
    };
    if !is_mapping && listed.len() != N {
        return refuse(format!(
            "recording: {} arrays, allowed: {N}, {}",
            listed.len(),
            names.join(", ")
        ));
    }
    let mut found = [const { Vec::new() }; N];
    for (number, name) in names.into_iter().enumerate() {
        let array = match listed.get(number) {
            Some(array) => array.clone(),
            None if recording.contains(name)? => recording.get_item(name)?,
            None => return refuse(format!("recording: no array {name}")),
        };
        found[number] = read_array::<f64, Ix1>(name, &array)?.as_array().to_vec();
    }
    Ok(found)
}

/// Channels with the names and units of time, displacement and force.
pub fn channels(
    [time, displacement, force]: [Option<String>; 3],
    [time_unit, displacement_unit, force_unit]: [Option<&str>; 3],
    group: Option<String>,
    skip_invalid: bool,
    header: Option<bool>,
    decimal_mark: Option<&str>,
) -> Outcome<Channels> {
    Ok(Channels {
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
    })
}

/// Parses a decimal mark, given by name or as the character itself.
fn mark(text: &str) -> Outcome<DecimalMark> {
    match text {
        "." | "point" => Ok(DecimalMark::Point),
        "," | "comma" => Ok(DecimalMark::Comma),
        other => refuse(format!(
            "decimal_mark: `{other}`, allowed: `point` or `comma`"
        )),
    }
}

/// Builds a channel with a given name and unit.
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
