//! The loop that is closed without delay, at many frequencies.

use nalgebra::linalg::{Hessenberg, balancing::balance_parlett_reinsch};
use nalgebra::{Complex, DMatrix, DVector};

use super::error::PlanError;
use super::plant::PlantWithoutDamper;

type C64 = Complex<f64>;

/// Part of its frequency by which a motion must grow or decay; rounding gives undamped motion either sign.
const MIN_DAMPING: f64 = 1e-9;
/// Part of the norm of the matrix below which an eigenvalue counts as zero.
const ZERO: f64 = 1e-14;
/// Smallest relative error of a response, and factor on the rounding of its matrix.
const ERROR: f64 = 1e-10;
const ERROR_OF_MATRIX: f64 = 4.0 * f64::EPSILON;

/// `T(s) = L/(1 + L) = C (s 1 - A)^-1 B`, the loop of a plant closed without delay. Its poles are the eigenvalues of
/// the plant with its damper.
pub(super) struct ClosedWithoutDelay {
    /// Upper Hessenberg, so that an evaluation costs the square of the number of states, not the cube.
    a: DMatrix<f64>,
    b: DVector<f64>,
    c: DVector<f64>,
    poles: Vec<C64>,
    /// `|C B|`, `|C A B|` and `|C A^2| |B|`, for the bound at high frequency.
    moments: [f64; 3],
    norm: f64,
}

impl ClosedWithoutDelay {
    /// Closes the loop of the plant.
    ///
    /// # Errors
    /// Eigenvalues are not found, or one is on the imaginary axis to within rounding.
    pub fn new(plant: &PlantWithoutDamper) -> Result<Self, PlanError> {
        let (open, b, c) = plant.open_loop();
        let closed = open - &b * c.transpose();
        let poles = dashpot_rail::eigenvalues(&closed).ok_or(PlanError::NoEigenvalues)?;
        let mut balanced = closed;
        let scale = balance_parlett_reinsch(&mut balanced);
        let (b, c) = (b.component_div(&scale), c.component_mul(&scale));
        let (q, a) = Hessenberg::new(balanced).unpack();
        let (b, c) = (q.tr_mul(&b), q.tr_mul(&c));
        let norm = a.norm();
        let undamped = poles
            .iter()
            .find(|pole| pole.re.abs() <= MIN_DAMPING * pole.norm() || pole.norm() <= ZERO * norm);
        if let Some(pole) = undamped {
            let frequency_hz = pole.im.abs() / std::f64::consts::TAU;
            return Err(PlanError::Undamped { frequency_hz });
        }
        let ca = a.tr_mul(&c);
        let moments = [
            c.dot(&b).abs(),
            ca.dot(&b).abs(),
            a.tr_mul(&ca).norm() * b.norm(),
        ];
        Ok(Self {
            a,
            b,
            c,
            poles,
            moments,
            norm,
        })
    }

    /// Eigenvalues of the plant with its damper, rad/s.
    pub fn poles(&self) -> &[C64] {
        &self.poles
    }

    /// Distance from `j omega` to the nearest pole, rad/s: the radius in which the response is a power series.
    pub fn distance(&self, omega: f64) -> f64 {
        let point = C64::new(0.0, omega);
        let distances = self.poles.iter().map(|pole| (point - pole).norm_sqr());
        distances.fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Relative error of a response at this distance from the nearest pole, by rounding.
    pub fn rounding(&self, distance: f64) -> f64 {
        ERROR + ERROR_OF_MATRIX * self.norm / distance
    }

    /// Norm of the balanced matrix, above which [`Self::bound`] holds, rad/s.
    pub fn norm(&self) -> f64 {
        self.norm
    }

    /// Upper bound of `|T|` at `omega` and above, for `omega` greater than the norm. It follows from
    /// `T = C B/s + C A B/s^2 + C A^2 (s 1 - A)^-1 B/s^2`.
    pub fn bound(&self, omega: f64) -> f64 {
        let [first, second, third] = self.moments;
        // What of `C B` and `C A B` is rounding vanishes in this bound too.
        first / omega + (second + third / (omega - self.norm)) / (omega * omega)
    }

    /// `T(j omega)` and its derivative with respect to `omega`.
    pub fn response(&self, omega: f64) -> (C64, C64) {
        let solver = Factors::new(&self.a, omega);
        let mut x: Vec<C64> = self.b.iter().map(|value| C64::from(*value)).collect();
        solver.solve(&mut x);
        let value = self.output(&x);
        solver.solve(&mut x);
        (value, self.output(&x) * C64::new(0.0, -1.0))
    }

    fn output(&self, x: &[C64]) -> C64 {
        let products = self.c.iter().zip(x).map(|(c, x)| x * *c);
        products.sum()
    }
}

/// `j omega 1 - A` with Hessenberg `A` as a product of row exchanges, row operations and an upper triangle.
struct Factors {
    size: usize,
    /// Rows of the upper triangle.
    rows: Vec<C64>,
    /// Whether each row was exchanged with the next, and its multiple that was taken from the next.
    steps: Vec<(bool, C64)>,
}

impl Factors {
    fn new(a: &DMatrix<f64>, omega: f64) -> Self {
        let size = a.nrows();
        let mut rows = vec![C64::from(0.0); size * size];
        for i in 0..size {
            for j in i.saturating_sub(1)..size {
                rows[i * size + j] = C64::from(-a[(i, j)]);
            }
            rows[i * size + i].im = omega;
        }
        let mut steps = Vec::with_capacity(size);
        for k in 0..size - 1 {
            let (upper, lower) = rows.split_at_mut((k + 1) * size);
            let (upper, lower) = (&mut upper[k * size + k..], &mut lower[k..size]);
            let is_exchanged = lower[0].norm_sqr() > upper[0].norm_sqr();
            if is_exchanged {
                upper.swap_with_slice(lower);
            }
            let factor = if lower[0] == C64::from(0.0) {
                C64::from(0.0)
            } else {
                lower[0] / upper[0]
            };
            for (lower, upper) in lower[1..].iter_mut().zip(&upper[1..]) {
                *lower -= factor * upper;
            }
            steps.push((is_exchanged, factor));
        }
        Self { size, rows, steps }
    }

    /// Replaces a right-hand side by the solution.
    fn solve(&self, x: &mut [C64]) {
        for (k, (is_exchanged, factor)) in self.steps.iter().enumerate() {
            if *is_exchanged {
                x.swap(k, k + 1);
            }
            let above = x[k];
            x[k + 1] -= factor * above;
        }
        for k in (0..self.size).rev() {
            let row = &self.rows[k * self.size..(k + 1) * self.size];
            let products = row[k + 1..].iter().zip(&x[k + 1..]).map(|(a, x)| a * x);
            let known: C64 = products.sum();
            x[k] = (x[k] - known) / row[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `m x'' + d x' + K x + f = 0`, whose response has a closed form.
    #[test]
    fn the_response_of_a_single_mass_is_its_closed_form() {
        let (m, d, spring, damping, stiffness) = (2.0, 0.3, 50.0, 4.0, 70.0);
        let a = DMatrix::from_row_slice(2, 2, &[-d / m, -spring / m, 1.0, 0.0]);
        let b = DVector::from_vec(vec![1.0 / m, 0.0]);
        let c = DVector::from_vec(vec![0.0, 1.0]);
        let plant = PlantWithoutDamper::new(a, b, c, damping, stiffness).unwrap();
        let closed = ClosedWithoutDelay::new(&plant).unwrap();
        let exact = |omega: f64| {
            let s = C64::new(0.0, omega);
            let damper = s * stiffness * damping / (s * damping + stiffness);
            damper / (s * s * m + s * d + spring + damper)
        };
        for omega in [1e-3, 0.7, 5.0, 8.3, 40.0, 1e3] {
            let (value, slope) = closed.response(omega);
            let (exact_value, h) = (exact(omega), 1e-4 * omega);
            assert!(
                (value - exact_value).norm() < 1e-12 * exact_value.norm(),
                "{omega}: {value} {exact_value}"
            );
            let exact_slope = (exact(omega + h) - exact(omega - h)) / (2.0 * h);
            assert!(
                (slope - exact_slope).norm() < 1e-6 * exact_slope.norm(),
                "{omega}: {slope} {exact_slope}"
            );
            if omega > closed.norm() {
                assert!(exact_value.norm() <= closed.bound(omega), "{omega}");
            }
        }
        assert!(1e3 > closed.norm());
    }
}
