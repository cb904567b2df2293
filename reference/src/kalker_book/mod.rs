//! Computes the tables of [`dashpot_rail::creep::KalkerBook`] from exact theory.

mod cells;
mod fit;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use cells::{
    Direction, creepage, direction, direction_coordinate, magnitude, moment_arm, spin_arm,
};
use dashpot_core::crc_32;
use dashpot_rail::creep::kalker_book::Layout;
use dashpot_rail::creep::{KalkerCoefficients, KalkerTable};
use fit::{End, fit};

use crate::error::ReferenceError;
use crate::rolling_contact::{RollingContact, ScaledForces, TOLERANCE, Tractions, full_sliding};

/// Poisson's ratio of the tables, that of steel.
pub const POISSON_RATIO: f64 = 0.28;

/// Revision of the method; increment it after a change to the solver, the mesh, the coordinates or the fit.
pub const REVISION: u32 = 2;

const SIZES: usize = Layout::CELLS[0];
const SPINS: usize = Layout::CELLS[1];
const DIRECTIONS: usize = Layout::CELLS[2];

/// Number of coefficients per size, over all spins and directions.
const LAYER: usize = (SPINS + 2) * (DIRECTIONS + 2);

/// Number of directions per ratio: one per cell, then pure spin.
const LINES: usize = SPINS * DIRECTIONS + 1;

/// Forces along one direction of creepage: their slope at size zero, their values at the middles of all `size` cells
/// except the first, and their values in full sliding.
type Line = [ScaledForces; SIZES + 1];

/// Computes all coefficients in the order of [`Layout`] on all processors; the result does not depend on their number.
/// Calls `progress` with the number of finished parts and the total.
///
/// # Errors
/// A contact does not converge.
pub fn coefficients(
    progress: impl Fn(usize, usize) + Sync,
) -> Result<Vec<[f32; 3]>, ReferenceError> {
    let kalker = KalkerTable::new(POISSON_RATIO).expect("steel is in Kalker's table");
    let contacts: Vec<_> = (0..Layout::RATIOS)
        .map(|index| {
            let a_over_b = Layout::a_over_b(index);
            let contact = RollingContact::new(a_over_b, POISSON_RATIO)?;
            Ok((a_over_b, contact, kalker.at(a_over_b)))
        })
        .collect::<Result<_, ReferenceError>>()?;
    let total = Layout::RATIOS * LINES;
    let next = AtomicUsize::new(0);
    let lines = Mutex::new((0..total).map(|_| None).collect::<Vec<_>>());
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= total {
                return;
            }
            let (a_over_b, contact, kalker) = &contacts[index / LINES];
            let part = index % LINES;
            let towards = if part == LINES - 1 {
                [0.0, 0.0, 1.0]
            } else {
                direction(part / DIRECTIONS, part % DIRECTIONS)
            };
            let line = line(*a_over_b, contact, kalker, towards);
            lines.lock().expect("no thread panics")[index] = Some(line);
            progress(index + 1, total);
        }
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(work);
        }
    });
    let lines: Vec<Line> = lines
        .into_inner()
        .expect("no thread panics")
        .into_iter()
        .map(|line| line.expect("every line is computed"))
        .collect::<Result<_, _>>()?;
    Ok(lines.chunks(LINES).flat_map(spline).collect())
}

/// Text of the file that describes how the tables with these bytes were computed.
pub fn provenance(bytes: &[u8]) -> String {
    let meshes: Vec<String> = (0..Layout::RATIOS)
        .map(|index| {
            let a_over_b = Layout::a_over_b(index);
            let [along, strips] = RollingContact::usual_mesh(a_over_b);
            format!("{a_over_b:.3}: {along} x {strips}")
        })
        .collect();
    let [size, spin, direction] = Layout::CELLS;
    format!(
        "Kalker's book of tables: creep forces of exact theory of rolling contact\n\
         written by: cargo xtask kalker-book (dashpot-reference, kalker_book), revision {REVISION}\n\
         solver: dashpot-reference, rolling_contact; tractions converged to {TOLERANCE} mu N\n\
         theory: elastic half-spaces, Hertz pressure, steady rolling, Coulomb friction (Kalker 1990)\n\
         linear theory at size 0: Kalker's coefficients of 1967 (kalker.csv); full sliding at size 1: quadrature\n\
         Poisson's ratio: {POISSON_RATIO}\n\
         cells: {size} sizes, {spin} spins, {direction} directions\n\
         a/b: elements along x strips: {}\n\
         layout: dashpot_rail::creep::kalker_book::Layout\n\
         bytes: {}\n\
         CRC-32: {:08x}\n",
        meshes.join(", "),
        bytes.len(),
        crc_32(bytes),
    )
}

fn line(
    a_over_b: f64,
    contact: &RollingContact,
    kalker: &KalkerCoefficients,
    towards: Direction,
) -> Result<Line, ReferenceError> {
    let [x, y, z] = towards;
    let mut line = [[0.0; 3]; SIZES + 1];
    let moment = kalker.c23 / kalker.c22 * y - kalker.c33 / kalker.c23 * z;
    line[0] = [-x, -(y + z), moment];
    let mut tractions = Tractions::default();
    for (cell, forces) in line.iter_mut().enumerate().take(SIZES).skip(1) {
        let creepage = creepage(towards.map(|x| x * magnitude(cell)), a_over_b, kalker);
        *forces = contact.solve_from(creepage, &mut tractions)?;
    }
    line[SIZES] = full_sliding(a_over_b, [x, y, z / spin_arm(a_over_b)]);
    for forces in &mut line {
        forces[2] /= moment_arm(a_over_b);
        // Spin alone causes no longitudinal force; the iteration leaves a small one within its tolerance.
        if x == 0.0 {
            forces[0] = 0.0;
        }
    }
    Ok(line)
}

/// Coefficients of one ratio, computed from its lines.
fn spline(lines: &[Line]) -> Vec<[f32; 3]> {
    let layers: Vec<[Vec<f64>; 3]> = (0..=SIZES)
        .map(|level| [0, 1, 2].map(|force| layer(lines, level, force)))
        .collect();
    let columns: Vec<[Vec<f64>; 3]> = (0..LAYER)
        .map(|index| {
            [0, 1, 2].map(|force| {
                let values: Vec<f64> = layers.iter().map(|layer| layer[force][index]).collect();
                over_size(&values)
            })
        })
        .collect();
    let at = |size: usize| move |column: &[Vec<f64>; 3]| [0, 1, 2].map(|k| column[k][size] as f32);
    (0..SIZES + 2)
        .flat_map(|size| columns.iter().map(at(size)))
        .collect()
}

/// Coefficients along the `size` axis, from the values of all levels at one index of a layer.
fn over_size(levels: &[f64]) -> Vec<f64> {
    // At size zero the spline must be zero and have a given slope, so the coefficients on both sides are opposite.
    let first = 0.5 * levels[0] / SIZES as f64;
    let ends = [End::coefficient(first), End::value(levels[SIZES])];
    let rest = fit(&levels[1..SIZES], ends);
    std::iter::once(-first).chain(rest).collect()
}

/// Coefficients of one force along `spin` and `direction` at one `size`, ordered by spin, then by direction.
fn layer(lines: &[Line], level: usize, force: usize) -> Vec<f64> {
    let square = |cell: usize| 1.0 + direction_coordinate(cell).powi(2);
    // The longitudinal force is odd in x, and x is zero at both ends, so this force is zero there. The other forces are
    // even: f = N / (1 + v^2) has zero slope at v = 1 if N' = N there.
    let half = 1.0 / DIRECTIONS as f64;
    let end = End::multiple(if force == 0 {
        -1.0
    } else {
        (1.0 + half) / (1.0 - half)
    });
    let along = |value: &dyn Fn(usize) -> f64| {
        let values: Vec<f64> = (0..DIRECTIONS)
            .map(|cell| value(cell) * square(cell))
            .collect();
        fit(&values, [end, end])
    };
    let rows: Vec<Vec<f64>> = (0..SPINS)
        .map(|spin| along(&|cell| lines[spin * DIRECTIONS + cell][level][force]))
        .collect();
    let pole = along(&|_| lines[LINES - 1][level][force]);
    // Negative spin gives the mirror image. The spline runs from pole to pole; only one half of it is kept.
    let mirror = if force == 0 { 1.0 } else { -1.0 };
    let columns: Vec<Vec<f64>> = (0..DIRECTIONS + 2)
        .map(|direction| {
            let image = DIRECTIONS + 1 - direction;
            let mirrored = rows.iter().rev().map(|row| mirror * row[image]);
            let values: Vec<f64> = mirrored
                .chain(rows.iter().map(|row| row[direction]))
                .collect();
            let ends = [mirror * pole[image], pole[direction]].map(End::value);
            fit(&values, ends)
        })
        .collect();
    (SPINS..2 * SPINS + 2)
        .flat_map(|spin| columns.iter().map(move |column| column[spin]))
        .collect()
}
