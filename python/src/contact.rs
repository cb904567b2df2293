//! Wheel-rail contact: the geometry of a wheelset on its track, and its contact under load.

use std::sync::Arc;

use dashpot_files::profile;
use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel};
use dashpot_rail::indices::RollingRadiusDifference;
use dashpot_rail::profile::measured::{DEFAULT_SMOOTHING_M, Options, Reading};
use dashpot_rail::profile::{Body, Profile};
use dashpot_study::loaded_wheelset::{
    LoadedPatch, LoadedShift, LoadedWheel, LoadedWheelset, Running,
};
use dashpot_study::profile_ends::end_contacts;
use dashpot_study::wheelset_geometry::{Conicity, Shift, WheelsetGeometry};
use numpy::PyArray1;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::contact_warnings;
use crate::error::{Outcome, Refusal, refuse};
use crate::overrides::path;

/// Named column of rows.
type Column<Row> = (&'static str, fn(&Row) -> f64);

/// Contact of a wheelset on a track. `dashpot.contact` returns it.
///
/// >>> import dashpot
/// >>> dashpot.contact().shifts["lateral_shift_m"].shape
/// (961,)
#[pyclass(module = "dashpot", frozen)]
pub struct Contact {
    conicity: Py<PyDict>,
    shifts: Py<PyDict>,
    under_load: Option<UnderLoad>,
}

/// Results under load.
struct UnderLoad {
    conicity: Py<PyDict>,
    wheels: Py<PyDict>,
    patches: Py<PyDict>,
}

#[pymethods]
impl Contact {
    /// Equivalent conicity of EN 15302: arrays `amplitude_m` and `equivalent_conicity`, NaN for amplitudes without a
    /// closed path.
    #[getter]
    fn conicity(&self, py: Python<'_>) -> Py<PyDict> {
        self.conicity.clone_ref(py)
    }

    /// Geometry of the rigid wheelset at lateral shifts (m), positive to the right, in steps of 25 um: arrays of
    /// rolling radius difference, roll, contact angles and contact positions on the wheels, named as in the output of
    /// `dashpot contact --format json`.
    #[getter]
    fn shifts(&self, py: Python<'_>) -> Py<PyDict> {
        self.shifts.clone_ref(py)
    }

    /// Equivalent conicity on elastic patches, as `conicity`; None without a load.
    #[getter]
    fn elastic_conicity(&self, py: Python<'_>) -> Option<Py<PyDict>> {
        let under_load = self.under_load.as_ref()?;
        Some(under_load.conicity.clone_ref(py))
    }

    /// Wheels under load, an array per quantity and a row per wheel; `side` is -1 for the left and 1 for the right
    /// wheel. The names are those of `dashpot contact --format json`. A shift without equilibrium has no rows. None
    /// without a load.
    #[getter]
    fn wheels(&self, py: Python<'_>) -> Option<Py<PyDict>> {
        let under_load = self.under_load.as_ref()?;
        Some(under_load.wheels.clone_ref(py))
    }

    /// Contact patches under load, as `wheels` with a row per patch. Lateral quantities are positive to the field side;
    /// forces and moments act on the wheel. None without a load.
    #[getter]
    fn patches(&self, py: Python<'_>) -> Option<Py<PyDict>> {
        let under_load = self.under_load.as_ref()?;
        Some(under_load.patches.clone_ref(py))
    }
}

/// Computes the contact of a wheelset. Each profile is built in (`s1002`, `uic60`) or a file in the format of MiniProf,
/// SIMPACK or GENSYS, or with two columns; `left_wheel` and `left_rail` are given if the left side differs.
///
/// The formats and mirrors are those of the command `dashpot contact`; give them if the file does not state them.
///
/// With `load_n`, the vertical load of each wheel, the result has the elastic patches, forces and conicity, at the
/// shifts `lateral_m` (default: every millimetre up to 8 mm), for the yaw, speed and friction given. A `UserWarning`
/// reports a rail file that contains its inclination, or a contact at the end of a profile.
///
/// >>> import dashpot
/// >>> conicity = dashpot.contact(gauge_m=1.435).conicity
/// >>> round(float(conicity["equivalent_conicity"][5]), 2)  # at 3 mm
/// 0.18
/// >>> loaded = dashpot.contact(load_n=100e3, lateral_m=[3e-3])
/// >>> [round(float(load_n), -4) for load_n in loaded.patches["load_n"]]
/// [100000.0, 100000.0]
#[pyfunction]
#[pyo3(signature = (
    wheel=None, rail=None, *, gauge_m=None, gauge_depth_m=None, back_to_back_m=None, back_to_datum_m=None,
    wheel_radius_m=None, inclination=None, smoothing_m=None,
    wheel_format=None, rail_format=None, wheel_mirror=None, rail_mirror=None,
    left_wheel=None, left_rail=None, left_wheel_format=None, left_rail_format=None,
    left_wheel_mirror=None, left_rail_mirror=None,
    load_n=None, lateral_m=None, yaw_rad=None, speed_m_per_s=None, friction=None
))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn contact(
    py: Python<'_>,
    wheel: Option<&Bound<'_, PyAny>>,
    rail: Option<&Bound<'_, PyAny>>,
    gauge_m: Option<f64>,
    gauge_depth_m: Option<f64>,
    back_to_back_m: Option<f64>,
    back_to_datum_m: Option<f64>,
    wheel_radius_m: Option<f64>,
    inclination: Option<f64>,
    smoothing_m: Option<f64>,
    wheel_format: Option<&str>,
    rail_format: Option<&str>,
    wheel_mirror: Option<&str>,
    rail_mirror: Option<&str>,
    left_wheel: Option<&Bound<'_, PyAny>>,
    left_rail: Option<&Bound<'_, PyAny>>,
    left_wheel_format: Option<&str>,
    left_rail_format: Option<&str>,
    left_wheel_mirror: Option<&str>,
    left_rail_mirror: Option<&str>,
    load_n: Option<f64>,
    lateral_m: Option<Vec<f64>>,
    yaw_rad: Option<f64>,
    speed_m_per_s: Option<f64>,
    friction: Option<f64>,
) -> Outcome<Contact> {
    let usual = Installation::default();
    let installation = Installation::default()
        .with_wheel_radius_m(wheel_radius_m.unwrap_or(usual.wheel_radius_m))
        .with_back_to_back_m(back_to_back_m.unwrap_or(usual.back_to_back_m))
        .with_back_to_datum_m(back_to_datum_m.unwrap_or(usual.back_to_datum_m))
        .with_gauge_m(gauge_m.unwrap_or(usual.gauge_m))
        .with_gauge_depth_m(gauge_depth_m.unwrap_or(usual.gauge_depth_m))
        .with_inclination(inclination.unwrap_or(usual.inclination));
    let usual = Running::default();
    let running = load_n.map(|load_n| {
        usual
            .with_load_n(load_n)
            .with_yaw_rad(yaw_rad.unwrap_or(usual.yaw_rad))
            .with_speed_m_per_s(speed_m_per_s.unwrap_or(usual.speed_m_per_s))
            .with_friction(friction.unwrap_or(usual.friction))
    });
    let is_load_described =
        lateral_m.is_some() || yaw_rad.is_some() || speed_m_per_s.is_some() || friction.is_some();
    if running.is_none() && is_load_described {
        return refuse(
            "load_n: none, required with lateral_m, yaw_rad, speed_m_per_s and friction",
        );
    }
    let named = |name: Option<&Bound<'_, PyAny>>, format, mirror| -> Outcome<_> {
        let name = name.map(path).transpose()?;
        Ok((name, options(format, mirror, smoothing_m)?))
    };
    let (wheel, wheel_options) = named(wheel, wheel_format, wheel_mirror)?;
    let (rail, rail_options) = named(rail, rail_format, rail_mirror)?;
    let is_stated =
        |format: Option<&str>, mirror: Option<&str>| format.is_some() || mirror.is_some();
    for (argument, is_missing) in [
        (
            "left_wheel",
            left_wheel.is_none() && is_stated(left_wheel_format, left_wheel_mirror),
        ),
        (
            "left_rail",
            left_rail.is_none() && is_stated(left_rail_format, left_rail_mirror),
        ),
    ] {
        if is_missing {
            return refuse(format!(
                "{argument}: none, required with {argument}_format and {argument}_mirror"
            ));
        }
    }
    let left_wheel = named(left_wheel, left_wheel_format, left_wheel_mirror)?;
    let left_rail = named(left_rail, left_rail_format, left_rail_mirror)?;
    let computed = py.detach(|| {
        let wheel = wheel.unwrap_or_else(|| "s1002".into());
        let rail = rail.unwrap_or_else(|| "uic60".into());
        let (wheel, _) = profile::load(&wheel, Body::Wheel, &wheel_options)?;
        let rail = profile::load(&rail, Body::Rail, &rail_options)?;
        let left = |(name, options): &(Option<String>, Options), body| -> Outcome<_> {
            let name = name.as_ref();
            Ok(name
                .map(|name| profile::load(name, body, options))
                .transpose()?)
        };
        let left_wheel = left(&left_wheel, Body::Wheel)?;
        let left_rail = left(&left_rail, Body::Rail)?;
        let right = Pair::new(wheel.clone(), &rail.0, installation)?;
        let is_symmetric = left_wheel.is_none() && left_rail.is_none();
        let left_pair = Pair::new(
            left_wheel.map_or(wheel, |(wheel, _)| wheel),
            left_rail.as_ref().map_or(&rail.0, |(rail, _)| rail),
            installation,
        )?;
        let geometry = WheelsetGeometry::new([&left_pair, &right])?;
        let elastic = running
            .map(|running| under_load([&left_pair, &right], is_symmetric, running, lateral_m))
            .transpose()?;
        let loaded = elastic.as_ref().map_or(&[][..], |(shifts, _)| shifts);
        let ends = end_contacts([&left_pair, &right], &geometry.contacts, loaded);
        let rails: Vec<(Profile, Option<Reading>)> =
            [Some(rail), left_rail].into_iter().flatten().collect();
        let tilts = contact_warnings::laid_twice(&rails, installation.inclination);
        let mut warnings = tilts;
        warnings.extend(contact_warnings::at_ends(&ends, is_symmetric));
        Ok::<_, Refusal>((geometry, elastic, warnings))
    })?;
    let (geometry, elastic, warnings) = computed;
    for words in warnings {
        let words = std::ffi::CString::new(words).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &words, 1)?;
    }
    let radius_m = installation.wheel_radius_m;
    Ok(Contact {
        conicity: conicity(py, &geometry.rolling, radius_m)?,
        shifts: shifts(py, &geometry)?,
        under_load: elastic
            .map(|(shifts, rolling)| {
                Ok::<_, Refusal>(UnderLoad {
                    conicity: conicity(py, &rolling, radius_m)?,
                    wheels: wheels(py, &shifts)?,
                    patches: patches(py, &shifts)?,
                })
            })
            .transpose()?,
    })
}

/// Computes the wheelset under load, and its rolling radius difference on elastic patches.
fn under_load(
    [left, right]: [&Pair; 2],
    is_symmetric: bool,
    running: Running,
    lateral_m: Option<Vec<f64>>,
) -> Outcome<(Vec<LoadedShift>, RollingRadiusDifference)> {
    let geometry = |pair: &Pair| ContactGeometry::new(pair.clone(), Steel::default()).map(Arc::new);
    let right = geometry(right)?;
    let left = if is_symmetric {
        Arc::clone(&right)
    } else {
        geometry(left)?
    };
    let wheelset = LoadedWheelset::new([left, right], running)?;
    let lateral_m = lateral_m.unwrap_or_else(|| wheelset.usual_shifts_m());
    Ok((
        wheelset.at(&lateral_m)?,
        wheelset.rolling_radius_difference()?,
    ))
}

/// A dictionary with an array per column.
fn arrays<Row>(py: Python<'_>, rows: &[Row], columns: &[Column<Row>]) -> Outcome<Py<PyDict>> {
    let dictionary = PyDict::new(py);
    for (name, of) in columns {
        dictionary.set_item(name, PyArray1::from_iter(py, rows.iter().map(of)))?;
    }
    Ok(dictionary.unbind())
}

fn conicity(
    py: Python<'_>,
    rolling: &RollingRadiusDifference,
    radius_m: f64,
) -> Outcome<Py<PyDict>> {
    let rows = Conicity::over_amplitude(rolling, radius_m);
    arrays(
        py,
        &rows,
        &[
            ("amplitude_m", |row| row.amplitude_m),
            ("equivalent_conicity", |row| {
                row.equivalent_conicity.unwrap_or(f64::NAN)
            }),
        ],
    )
}

fn shifts(py: Python<'_>, geometry: &WheelsetGeometry) -> Outcome<Py<PyDict>> {
    let rows: Vec<Shift> = geometry.contacts.iter().map(Shift::from).collect();
    arrays(
        py,
        &rows,
        &[
            ("lateral_shift_m", |row| row.lateral_shift_m),
            ("rolling_radius_difference_m", |row| {
                row.rolling_radius_difference_m
            }),
            ("roll_rad", |row| row.roll_rad),
            ("contact_angle_left_rad", |row| row.contact_angle_left_rad),
            ("contact_angle_right_rad", |row| row.contact_angle_right_rad),
            ("wheel_place_left_m", |row| row.wheel_place_left_m),
            ("wheel_place_right_m", |row| row.wheel_place_right_m),
        ],
    )
}

fn wheels(py: Python<'_>, shifts: &[LoadedShift]) -> Outcome<Py<PyDict>> {
    type Row<'a> = (f64, i8, &'a LoadedWheel);
    let rows: Vec<Row<'_>> = shifts
        .iter()
        .flat_map(|shift| {
            let wheels = shift.wheels();
            wheels.map(|(side, wheel)| (shift.lateral_shift_m, side, wheel))
        })
        .collect();
    arrays(
        py,
        &rows,
        &[
            ("lateral_shift_m", |row| row.0),
            ("side", |row| f64::from(row.1)),
            ("vertical_force_n", |row| row.2.vertical_force_n),
            ("lateral_force_n", |row| row.2.lateral_force_n),
            ("derailment_coefficient", |row| row.2.derailment_coefficient),
            ("longitudinal_force_n", |row| row.2.longitudinal_force_n),
            ("rolling_radius_m", |row| row.2.rolling_radius_m),
        ],
    )
}

fn patches(py: Python<'_>, shifts: &[LoadedShift]) -> Outcome<Py<PyDict>> {
    type Row<'a> = (f64, i8, &'a LoadedPatch);
    let rows: Vec<Row<'_>> = shifts
        .iter()
        .flat_map(|shift| {
            shift.wheels().flat_map(move |(side, wheel)| {
                let patches = wheel.patches.iter();
                patches.map(move |patch| (shift.lateral_shift_m, side, patch))
            })
        })
        .collect();
    arrays(
        py,
        &rows,
        &[
            ("lateral_shift_m", |row| row.0),
            ("side", |row| f64::from(row.1)),
            ("load_n", |row| row.2.load_n),
            ("wheel_y_m", |row| row.2.wheel_y_m),
            ("track_y_m", |row| row.2.track_y_m),
            ("track_z_m", |row| row.2.track_z_m),
            ("contact_angle_rad", |row| row.2.contact_angle_rad),
            ("semi_axis_rolling_m", |row| row.2.semi_axis_rolling_m),
            ("semi_axis_across_m", |row| row.2.semi_axis_across_m),
            ("peak_pressure_pa", |row| row.2.peak_pressure_pa),
            ("rolling_radius_m", |row| row.2.rolling_radius_m),
            ("longitudinal_creepage", |row| row.2.longitudinal_creepage),
            ("lateral_creepage", |row| row.2.lateral_creepage),
            ("spin_creepage_per_m", |row| row.2.spin_creepage_per_m),
            ("longitudinal_creep_force_n", |row| {
                row.2.longitudinal_creep_force_n
            }),
            ("lateral_creep_force_n", |row| row.2.lateral_creep_force_n),
            ("spin_moment_n_m", |row| row.2.spin_moment_n_m),
            ("dissipation_w", |row| row.2.dissipation_w),
        ],
    )
}

fn options(
    format: Option<&str>,
    mirror: Option<&str>,
    smoothing_m: Option<f64>,
) -> Outcome<Options> {
    Ok(Options::default()
        .with_format(format.map(str::parse).transpose().or_else(refuse)?)
        .with_mirror(mirror.map(str::parse).transpose().or_else(refuse)?)
        .with_smoothing_m(smoothing_m.unwrap_or(DEFAULT_SMOOTHING_M)))
}
