//! Creep forces of a loaded contact.

use dashpot_rail::contact::Steel;
use dashpot_rail::creep::{CreepLaw, Creepage, KalkerBook, KalkerTable, LoadedContact};
use numpy::{Ix2, PyArray1, PyArray2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays;
use crate::error::{Outcome, Refusal, refuse};
use crate::interruption::run_cancellable;

/// Rows between two checks for an interruption.
const ROWS_A_LOOK: usize = 1 << 12;

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
