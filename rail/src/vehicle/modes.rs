//! Natural modes of linear equations of motion.

use nalgebra::{Complex, DMatrix, DVector};

use super::body::{Body, COORDINATES, Coordinate};
use super::error::VehicleError;
use super::linear::Linear;
use crate::math::eigenvalues::eigenvalues;

/// A natural mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Real and imaginary part of the eigenvalue `lambda`, rad/s; the motion is `exp(lambda t)`.
    eigenvalue: [f64; 2],
    /// All coordinates of all bodies, by decreasing share of the kinetic energy.
    shares: Vec<Share>,
}

#[derive(Debug, Clone, PartialEq)]
struct Share {
    body: String,
    coordinate: Coordinate,
    /// Fraction of the kinetic energy.
    energy: f64,
    /// True if it moves in phase with the coordinate that has the largest share, false if in antiphase.
    moves_with_first: bool,
}

/// A second body is named if its share of the energy exceeds this fraction of the first body's share.
const NAMED: f64 = 0.25;

impl Mode {
    /// Returns the real and imaginary part of the eigenvalue `lambda`, rad/s. The motion is `exp(lambda t)`; the
    /// imaginary part is positive.
    pub fn eigenvalue_rad_per_s(&self) -> [f64; 2] {
        self.eigenvalue
    }

    /// Returns the magnitude of the eigenvalue divided by `2 pi`, Hz: the undamped frequency of a single-mass
    /// oscillator.
    pub fn undamped_hz(&self) -> f64 {
        let [real, imaginary] = self.eigenvalue;
        libm::hypot(real, imaginary) / (2.0 * std::f64::consts::PI)
    }

    /// Returns the frequency of the motion, Hz.
    pub fn damped_hz(&self) -> f64 {
        self.eigenvalue[1] / (2.0 * std::f64::consts::PI)
    }

    /// Returns the fraction of critical damping; negative if the motion grows.
    pub fn damping_ratio(&self) -> f64 {
        let [real, imaginary] = self.eigenvalue;
        -real / libm::hypot(real, imaginary)
    }

    /// Names the bodies with the most kinetic energy and their motion, for example `body bounce`.
    pub fn description(&self) -> String {
        let first = &self.shares[0];
        let coordinate = first.coordinate;
        let mut bodies = vec![first.body.as_str()];
        let mut opposed = false;
        for share in &self.shares[1..] {
            if share.coordinate == coordinate && share.energy > NAMED * first.energy {
                bodies.push(&share.body);
                opposed |= !share.moves_with_first;
            }
        }
        let against = if opposed { ", opposed" } else { "" };
        format!("{} {}{against}", bodies.join(" and "), self.motion())
    }

    /// Motion of the first body. Lateral motion with roll is a lower sway if the centre of rotation is below the body,
    /// and an upper sway if it is above.
    fn motion(&self) -> &'static str {
        let first = &self.shares[0];
        let other = match first.coordinate {
            Coordinate::Vertical => return "bounce",
            Coordinate::Pitch => return "pitch",
            Coordinate::Yaw => return "yaw",
            Coordinate::Lateral => Coordinate::Roll,
            Coordinate::Roll => Coordinate::Lateral,
        };
        let coupled = self
            .shares
            .iter()
            .find(|share| share.body == first.body && share.coordinate == other);
        match coupled {
            Some(coupled) if coupled.energy > 0.02 => {
                if coupled.moves_with_first == first.moves_with_first {
                    "lower sway"
                } else {
                    "upper sway"
                }
            }
            _ if first.coordinate == Coordinate::Lateral => "lateral",
            _ => "roll",
        }
    }
}

/// Real and imaginary parts of all eigenvalues of the state matrix, rad/s.
pub(super) fn eigenvalues_rad_per_s(linear: &Linear) -> Result<Vec<[f64; 2]>, VehicleError> {
    let values = eigenvalues(&linear.first_order()).ok_or(VehicleError::NoModes)?;
    Ok(values.iter().map(|value| [value.re, value.im]).collect())
}

/// Rows of the state matrix.
pub(super) fn state_matrix(linear: &Linear) -> Vec<Vec<f64>> {
    let matrix = linear.first_order();
    matrix
        .row_iter()
        .map(|row| row.iter().copied().collect())
        .collect()
}

/// Oscillating modes in order of frequency.
pub(super) fn oscillating(linear: &Linear, bodies: &[Body]) -> Result<Vec<Mode>, VehicleError> {
    let matrix = linear.first_order();
    let values = eigenvalues(&matrix).ok_or(VehicleError::NoModes)?;
    let mut modes: Vec<Mode> = values
        .iter()
        .enumerate()
        .filter(|(_, value)| value.im > 1e-9 * value.norm())
        .map(|(number, value)| Mode {
            eigenvalue: [value.re, value.im],
            shares: shares(&shape(&matrix, *value, number), linear, bodies),
        })
        .collect();
    modes.sort_by(|a, b| a.undamped_hz().total_cmp(&b.undamped_hz()));
    Ok(modes)
}

/// Eigenvector of an eigenvalue by inverse iteration. The start vector depends on `number`, so that equal eigenvalues
/// get different eigenvectors.
fn shape(matrix: &DMatrix<f64>, value: Complex<f64>, number: usize) -> DVector<Complex<f64>> {
    let size = matrix.nrows();
    // Slightly off the eigenvalue, at which the matrix would be singular.
    let shift = value * (1.0 + 1e-7);
    let shifted = DMatrix::from_fn(size, size, |i, j| {
        Complex::from(matrix[(i, j)]) - if i == j { shift } else { Complex::from(0.0) }
    });
    let solver = shifted.lu();
    let mut shape = DVector::from_fn(size, |i, _| {
        Complex::new(1.0 + libm::sin((i * (number + 1)) as f64), 0.3)
    });
    for _ in 0..3 {
        if let Some(next) = solver.solve(&shape) {
            shape = &next / Complex::from(next.norm());
        }
    }
    shape
}

fn shares(shape: &DVector<Complex<f64>>, linear: &Linear, bodies: &[Body]) -> Vec<Share> {
    let n = linear.inertia.len();
    let energies: Vec<f64> = (0..n)
        .map(|i| linear.inertia[i] * shape[i].norm_sqr())
        .collect();
    let total: f64 = energies.iter().sum();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| energies[*b].total_cmp(&energies[*a]));
    let first = shape[order[0]];
    order
        .into_iter()
        .map(|i| Share {
            body: bodies[i / COORDINATES.len()].name.clone(),
            coordinate: COORDINATES[i % COORDINATES.len()],
            energy: energies[i] / total,
            moves_with_first: (shape[i] * first.conj()).re >= 0.0,
        })
        .collect()
}
