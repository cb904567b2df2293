//! Rightmost roots of a vehicle whose damper force is late, by collocation: an independent solution for the plan of a
//! test, which shares only the eigenvalues of a matrix with it. The tests of vehicles compare those with LAPACK's.
//!
//! The delayed force is carried along the interval of the delay by `y_t = y_theta`, discretised at Chebyshev points:
//! the infinitesimal generator of D. Breda, S. Maset, R. Vermiglio, "Pseudospectral differencing methods for
//! characteristic roots of delay differential equations", SIAM J. Sci. Comput. 27 (2005) 482-495. Only one number is
//! delayed, so each point adds one state.

use std::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector, RowDVector};

/// Points of the delay.
const POINTS: usize = 40;

/// `x' = A x - b f`, `e = c x`, and a damper with damping `d` and stiffness `k`.
#[derive(Clone, Debug)]
pub struct System {
    pub a: DMatrix<f64>,
    pub b: DVector<f64>,
    pub c: DVector<f64>,
    pub d: f64,
    pub k: f64,
    /// Angular frequency and damping ratio of an actuator of second order, through which the force passes.
    pub actuator: Option<[f64; 2]>,
}

impl System {
    /// Roots whose force is late by `delay_s`. Those near the axis, of a phase well below that of the points, are exact
    /// to many digits. Without a delay all are exact.
    pub fn roots(&self, delay_s: f64) -> Vec<Complex<f64>> {
        let states = self.b.len();
        let points = if delay_s > 0.0 { POINTS } else { 0 };
        // States, the extension of the dashpot, the force at the points of the delay, the actuator and its rate.
        let (dashpot, last) = (states, states + points);
        let actuator = last + 1;
        let size = actuator + self.actuator.map_or(0, |_| 2);
        let mut matrix = DMatrix::zeros(size, size);
        matrix.view_mut((0, 0), (states, states)).copy_from(&self.a);
        // The force without delay is k (e - x), and the dashpot's x' = k/d (e - x).
        let mut force = RowDVector::zeros(size);
        force
            .columns_mut(0, states)
            .copy_from(&(self.c.transpose() * self.k));
        force[dashpot] = -self.k;
        matrix.set_row(dashpot, &(&force / self.d));
        if points > 0 {
            let derivative = chebyshev(points) * (2.0 / delay_s);
            for i in 1..=points {
                let mut row = &force * derivative[(i, 0)];
                for j in 1..=points {
                    row[dashpot + j] += derivative[(i, j)];
                }
                matrix.set_row(dashpot + i, &row);
            }
        }
        let mut delayed = force;
        if points > 0 {
            delayed.fill(0.0);
            delayed[last] = 1.0;
        }
        let mut felt = delayed.clone();
        if self.actuator.is_some() {
            felt.fill(0.0);
            felt[actuator] = 1.0;
        }
        for i in 0..states {
            let row = matrix.row(i) - &felt * self.b[i];
            matrix.set_row(i, &row);
        }
        if let Some([omega, damping]) = self.actuator {
            let square = omega * omega;
            let mut row = delayed * square;
            row[actuator] -= square;
            row[actuator + 1] -= 2.0 * damping * omega;
            matrix.set_row(actuator + 1, &row);
            matrix[(actuator, actuator + 1)] = 1.0;
        }
        dashpot_rail::eigenvalues(&matrix).expect("eigenvalues")
    }

    /// Largest real part of a root.
    pub fn rightmost(&self, delay_s: f64) -> f64 {
        let parts = self.roots(delay_s).into_iter().map(|root| root.re);
        parts.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Derivatives at the points `cos(i pi/n)` of the polynomial through its values there (L. N. Trefethen, "Spectral
/// methods in Matlab", 2000, chapter 6).
fn chebyshev(n: usize) -> DMatrix<f64> {
    let at = |i: usize| (PI * i as f64 / n as f64).cos();
    let weight = |i: usize| {
        let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        if i == 0 || i == n { 2.0 * sign } else { sign }
    };
    let mut matrix = DMatrix::from_fn(n + 1, n + 1, |i, j| {
        if i == j {
            0.0
        } else {
            weight(i) / weight(j) / (at(i) - at(j))
        }
    });
    for i in 0..=n {
        matrix[(i, i)] = -matrix.row(i).sum();
    }
    matrix
}

/// The root of `x' = -x(t - 1)` nearest to the axis is Lambert's `W(-1)`.
#[test]
fn a_known_equation_has_its_known_root() {
    // A spring of 1 N/m, whose dashpot is very stiff, moved by a velocity of minus the force: f' = e' = -f(t - 1).
    let system = System {
        a: DMatrix::from_element(1, 1, 0.0),
        b: DVector::from_element(1, 1.0),
        c: DVector::from_element(1, 1.0),
        d: 1e9,
        k: 1.0,
        actuator: None,
    };
    let expected = Complex::new(-0.318_131_505_204_764, 1.337_235_701_430_689);
    let nearest = |root: &Complex<f64>| (root - expected).norm();
    let distances = system.roots(1.0).iter().map(nearest).fold(1.0, f64::min);
    assert!(distances < 1e-8, "{distances}");
}
