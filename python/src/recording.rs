//! Recordings from files as arrays.

use std::path::Path;

use dashpot_core::parameters::STEP_RANGE_S;
use dashpot_hil::files::recording::{Channel, Channels, Measurement, Quantity, Recording};
use dashpot_hil::study::StudyError;
use dashpot_hil::study::tick_grid::{TickGrid, nearest_nanosecond};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{Outcome, Refusal, refuse};
use crate::overrides::path as path_of;

/// Reads a recording, CSV, MDF4 or Parquet: arrays `time_s` and `displacement_m`, and `force_n` where `with_force`.
///
/// With `step_s` (s) it is read on the ticks of that step, linear between samples, as `dashpot replay` does. `time`, `displacement` and `force`
/// name the channels, `time_unit`, `displacement_unit` and `force_unit` their units, where the file does not tell.
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
    displacement_unit=None, force_unit=None, group=None, skip_invalid=false
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
) -> Outcome<Bound<'py, PyDict>> {
    let channels = Channels {
        time: channel(Quantity::Time, time, time_unit)?,
        displacement: channel(Quantity::Displacement, displacement, displacement_unit)?,
        force: channel(Quantity::Force, force, force_unit)?,
        group,
        skip_invalid,
        ..Channels::default()
    };
    let path = path_of(path)?;
    let path = Path::new(&path);
    if step_s.is_some() && with_force {
        return refuse("step_s with with_force: allowed: one of them");
    }
    let columns: Vec<(&str, Vec<f64>)> = py.detach(|| {
        if with_force {
            let samples = Measurement::open(path, &channels)?.read_all()?;
            let column = |of: fn(&_) -> f64| samples.iter().map(of).collect();
            return Ok::<_, Refusal>(vec![
                ("time_s", column(|sample| sample.time_s)),
                ("displacement_m", column(|sample| sample.displacement_m)),
                ("force_n", column(|sample| sample.force_n)),
            ]);
        }
        let recording = || Recording::open_with(path, &channels);
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
    })?;
    let arrays = PyDict::new(py);
    for (name, column) in columns {
        arrays.set_item(name, PyArray1::from_vec(py, column))?;
    }
    Ok(arrays)
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
