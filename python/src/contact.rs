//! Wheel-rail contact: the geometry of a pair of profiles, and creep forces.

use dashpot_files::profile;
use dashpot_rail::contact::{Installation, Pair, Steel};
use dashpot_rail::creep::{CreepLaw, Creepage, KalkerBook, KalkerTable, LoadedContact};
use dashpot_rail::profile::Body;
use dashpot_rail::profile::measured::{DEFAULT_SMOOTHING_M, Options};
use dashpot_study::wheelset_geometry::{ForceJump, Shift, WheelsetGeometry};
use numpy::{Ix2, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_cancellable;
use crate::overrides::path;

/// Rows between two checks for an interruption.
const ROWS_A_LOOK: usize = 1 << 12;

/// Extracts one value from a row.
type Column = fn(&Shift) -> f64;

/// Geometry of a wheelset on a track. `dashpot.contact` returns it.
///
/// >>> import dashpot
/// >>> dashpot.contact().shifts["lateral_shift_m"].shape
/// (961,)
#[pyclass(module = "dashpot", frozen)]
pub struct Contact {
    conicity: Py<PyDict>,
    shifts: Py<PyDict>,
    force_jump: Option<ForceJump>,
}

#[pymethods]
impl Contact {
    /// Equivalent conicity of EN 15302: arrays `amplitude_m` and `equivalent_conicity`, NaN for amplitudes without a
    /// closed path.
    #[getter]
    fn conicity(&self, py: Python<'_>) -> Py<PyDict> {
        self.conicity.clone_ref(py)
    }

    /// The force jump that makes contact tables of this pair impossible; `None` without such a jump.
    ///
    /// It is a dictionary with the position (`lateral_m`, `roll_rad`, `yaw_rad`), the load `load_n`, the jump `jump_n`,
    /// and `allowed_n`, the jump that the stiffness of the contact allows.
    ///
    /// >>> import dashpot
    /// >>> dashpot.contact().force_jump is None
    /// True
    #[getter]
    fn force_jump<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(jump) = &self.force_jump else {
            return Ok(None);
        };
        let numbers = PyDict::new(py);
        for (name, number) in [
            ("lateral_m", jump.lateral_m),
            ("roll_rad", jump.roll_rad),
            ("yaw_rad", jump.yaw_rad),
            ("load_n", jump.load_n),
            ("jump_n", jump.jump_n),
            ("allowed_n", jump.allowed_n),
        ] {
            numbers.set_item(name, number)?;
        }
        Ok(Some(numbers))
    }

    /// Geometry of the rigid wheelset at lateral shifts (m), positive to the right, in steps of 25 um: arrays of
    /// rolling radius difference, roll, contact angles and contact positions on the wheels, named as in the output of
    /// `dashpot contact --format json`.
    #[getter]
    fn shifts(&self, py: Python<'_>) -> Py<PyDict> {
        self.shifts.clone_ref(py)
    }
}

/// Computes the geometry of a wheel on a rail. Each profile is built in (`s1002`, `uic60`) or a file in the format of
/// MiniProf, SIMPACK or GENSYS, or with two columns.
///
/// The formats and mirrors are those of the command `dashpot contact`; give them if the file does not state them.
///
/// >>> import dashpot
/// >>> conicity = dashpot.contact(gauge_m=1.435).conicity
/// >>> round(float(conicity["equivalent_conicity"][5]), 2)  # at 3 mm
/// 0.18
#[pyfunction]
#[pyo3(signature = (
    wheel=None, rail=None, *, gauge_m=None, gauge_depth_m=None, back_to_back_m=None, back_to_datum_m=None,
    wheel_radius_m=None, inclination=None, smoothing_m=None,
    wheel_format=None, rail_format=None, wheel_mirror=None, rail_mirror=None
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
) -> Outcome<Contact> {
    let usual = Installation::default();
    let installation = Installation::default()
        .with_wheel_radius_m(wheel_radius_m.unwrap_or(usual.wheel_radius_m))
        .with_back_to_back_m(back_to_back_m.unwrap_or(usual.back_to_back_m))
        .with_back_to_datum_m(back_to_datum_m.unwrap_or(usual.back_to_datum_m))
        .with_gauge_m(gauge_m.unwrap_or(usual.gauge_m))
        .with_gauge_depth_m(gauge_depth_m.unwrap_or(usual.gauge_depth_m))
        .with_inclination(inclination.unwrap_or(usual.inclination));
    let of_wheel = options(wheel_format, wheel_mirror, smoothing_m)?;
    let of_rail = options(rail_format, rail_mirror, smoothing_m)?;
    let wheel = wheel.map_or_else(|| Ok("s1002".into()), path)?;
    let rail = rail.map_or_else(|| Ok("uic60".into()), path)?;
    let (pair, geometry, force_jump) = py.detach(|| {
        let (wheel, _) = profile::load(&wheel, Body::Wheel, &of_wheel)?;
        let (rail, _) = profile::load(&rail, Body::Rail, &of_rail)?;
        let pair = Pair::new(wheel, &rail, installation)?;
        let geometry = WheelsetGeometry::new(&pair)?;
        let force_jump = ForceJump::find(&pair);
        Ok::<_, Refusal>((pair, geometry, force_jump))
    })?;
    let conicities = geometry.conicities(&pair);
    let conicity = PyDict::new(py);
    let amplitudes = conicities.iter().map(|one| one.amplitude_m);
    conicity.set_item("amplitude_m", PyArray1::from_iter(py, amplitudes))?;
    let values = conicities
        .iter()
        .map(|one| one.equivalent_conicity.unwrap_or(f64::NAN));
    conicity.set_item("equivalent_conicity", PyArray1::from_iter(py, values))?;
    let rows: Vec<Shift> = geometry.contacts.iter().map(Shift::from).collect();
    let columns: [(&str, Column); 7] = [
        ("lateral_shift_m", |row| row.lateral_shift_m),
        ("rolling_radius_difference_m", |row| {
            row.rolling_radius_difference_m
        }),
        ("roll_rad", |row| row.roll_rad),
        ("contact_angle_left_rad", |row| row.contact_angle_left_rad),
        ("contact_angle_right_rad", |row| row.contact_angle_right_rad),
        ("wheel_place_left_m", |row| row.wheel_place_left_m),
        ("wheel_place_right_m", |row| row.wheel_place_right_m),
    ];
    let shifts = PyDict::new(py);
    for (name, of) in columns {
        shifts.set_item(name, PyArray1::from_iter(py, rows.iter().map(of)))?;
    }
    Ok(Contact {
        conicity: conicity.unbind(),
        shifts: shifts.unbind(),
        force_jump,
    })
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

/// Computes creep forces on the wheel by the exact theory of rolling contact, from Kalker's book of tables.
///
/// `creepages` is a float64 array with the columns longitudinal, lateral (1) and spin (1/m). The result has one row for
/// each of its rows, with the columns longitudinal force, lateral force (N) and spin moment (N m).
///
/// `a_m` and `b_m` are the semi-axes of the contact in the rolling and in the lateral direction. The shear modulus and
/// Poisson's ratio are those of steel by default.
///
/// >>> import dashpot, numpy
/// >>> braking = numpy.array([[1.6e-3, 0.0, 0.0]])
/// >>> forces = dashpot.creep_forces(braking, load_n=106.7e3, a_m=6.304e-3, b_m=12.61e-3, friction=0.33,
/// ...     shear_modulus_pa=82e9, poisson_ratio=0.28)
/// >>> bool(abs(forces[0, 0] / -27.57e3 - 1) < 0.02)  # an independent solver gives 27.57 kN
/// True
#[pyfunction]
#[pyo3(signature = (creepages, *, load_n, a_m, b_m, friction, shear_modulus_pa=None, poisson_ratio=None))]
#[expect(clippy::too_many_arguments, reason = "Python callers name arguments")]
pub fn creep_forces<'py>(
    py: Python<'py>,
    creepages: &Bound<'py, PyAny>,
    load_n: f64,
    a_m: f64,
    b_m: f64,
    friction: f64,
    shear_modulus_pa: Option<f64>,
    poisson_ratio: Option<f64>,
) -> Outcome<Bound<'py, PyArray2<f64>>> {
    let rows = arrays::read::<f64, Ix2>("creepages", creepages)?;
    let columns = rows.shape()[1];
    if columns != 3 {
        return refuse(format!(
            "creepages: {columns} columns, allowed: 3, longitudinal, lateral and spin"
        ));
    }
    let shear_modulus_pa = shear_modulus_pa.unwrap_or_else(|| Steel::default().shear_modulus_pa());
    let poisson_ratio = poisson_ratio.unwrap_or(Steel::default().poisson_ratio);
    let given = [
        ("load_n", load_n),
        ("a_m", a_m),
        ("b_m", b_m),
        ("friction", friction),
        ("shear_modulus_pa", shear_modulus_pa),
    ];
    if let Some((name, wrong)) = given
        .into_iter()
        .find(|(_, value)| !(*value > 0.0 && value.is_finite()))
    {
        return refuse(format!("{name}: {wrong}, allowed: above 0"));
    }
    for (name, axis_m) in [("a_m", a_m), ("b_m", b_m)] {
        if !(1e-6..=1.0).contains(&axis_m) {
            return refuse(format!("{name}: {axis_m}, allowed: 1e-6 to 1"));
        }
    }
    let numbers = rows.as_slice().map_err(PyErr::from)?;
    if let Some(index) = numbers.iter().position(|number| !number.is_finite()) {
        return refuse(format!(
            "creepages: row {} has {}, allowed: finite numbers",
            index / columns,
            numbers[index]
        ));
    }
    let forces: Vec<f64> = py.detach(|| {
        let kalker = KalkerTable::new(poisson_ratio).map(|table| table.at(a_m / b_m));
        let contact = LoadedContact {
            load_n,
            a_m,
            b_m,
            shear_modulus_pa,
            kalker: kalker?,
            friction,
        };
        let book = KalkerBook::new();
        let (rows, _) = numbers.as_chunks::<3>();
        let mut forces = Vec::with_capacity(numbers.len());
        run_cancellable(|is_unwanted| {
            let parts = rows.chunks(ROWS_A_LOOK);
            for &[longitudinal, lateral, spin_per_m] in
                parts.take_while(|_| !is_unwanted()).flatten()
            {
                let creepage = Creepage {
                    longitudinal,
                    lateral,
                    spin_per_m,
                };
                forces.extend(book.forces(&contact, &creepage).components());
            }
        })?;
        Ok::<_, Refusal>(forces)
    })?;
    Ok(PyArray1::from_vec(py, forces).reshape([rows.shape()[0], 3])?)
}
