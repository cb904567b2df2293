//! Eigenvalues of a real matrix: balancing, Hessenberg form, QR iteration with Francis' double shift and exceptional
//! shifts.

use nalgebra::linalg::{Hessenberg, balancing::balance_parlett_reinsch};
use nalgebra::{Complex, DMatrix};

/// Number of iterations for one eigenvalue from one exceptional shift to the next. The usual shifts can make the
/// iteration cycle; an exceptional shift breaks the cycle.
const EXCEPTIONAL_EACH: usize = 10;

/// Maximum iterations for one eigenvalue, per row of the matrix; an eigenvalue usually takes three in all.
const MAX_ITERATIONS_PER_ROW: usize = 30;

/// Computes the eigenvalues of `matrix`, unordered, with conjugate pairs adjacent. `None` if an entry is not finite, or
/// if the iteration does not converge, which is not known to happen.
///
/// The algorithm is that of LAPACK's `dhseqr` for small matrices (`dlahqr`): Francis' implicit double shift (1961),
/// deflation by the criterion of Ahues and Tisseur (LAPACK Working Note 122, 1997).
///
/// ```
/// let rotation = nalgebra::DMatrix::from_row_slice(2, 2, &[0.0, -3.0, 3.0, 0.0]);
/// let values = dashpot_rail::eigenvalues(&rotation).unwrap();
/// assert_eq!(values[0].im.abs(), 3.0);
/// ```
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    // Balancing does not terminate with an infinite entry.
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let mut balanced = matrix.clone();
    balance_parlett_reinsch(&mut balanced);
    let mut iteration = Iteration {
        h: Hessenberg::new(balanced).unpack_h(),
    };
    let mut found = Vec::with_capacity(matrix.nrows());
    let mut size = matrix.nrows();
    while size > 0 {
        let first = iteration.deflate(size - 1)?;
        let h = &iteration.h;
        if first + 1 == size {
            found.push(Complex::from(h[(first, first)]));
        } else {
            found.extend(eigenvalues_of_two([
                [h[(first, first)], h[(first, first + 1)]],
                [h[(first + 1, first)], h[(first + 1, first + 1)]],
            ]));
        }
        size = first;
    }
    Some(found)
}

/// A Hessenberg matrix that is deflated by one or two rows at a time.
struct Iteration {
    h: DMatrix<f64>,
}

/// Two shifts, both real or complex conjugates: their real parts, and the imaginary part of the first.
#[derive(Clone, Copy)]
struct Shifts {
    real: [f64; 2],
    imaginary: f64,
}

impl Iteration {
    /// Iterates until one or two rows up to `last` are decoupled from the rows before; returns the first of them.
    fn deflate(&mut self, last: usize) -> Option<usize> {
        let limit = MAX_ITERATIONS_PER_ROW * self.h.nrows().max(10);
        for iteration in 1..=limit {
            let first = self.start_of_block(last);
            if first > 0 {
                self.h[(first, first - 1)] = 0.0;
            }
            if first + 1 >= last {
                return Some(first);
            }
            let shifts = self.shifts(first, last, iteration);
            self.sweep(first, last, shifts);
        }
        None
    }

    /// First row of the unreduced block that ends at `last`. The subdiagonal entry in front of it is negligible.
    fn start_of_block(&self, last: usize) -> usize {
        let h = &self.h;
        let mut row = last;
        while row > 0 {
            let below = h[(row, row - 1)].abs();
            if below <= f64::MIN_POSITIVE {
                break;
            }
            let [before, here] = [h[(row - 1, row - 1)], h[(row, row)]];
            let mut scale = before.abs() + here.abs();
            if scale == 0.0 {
                if row >= 2 {
                    scale += h[(row - 1, row - 2)].abs();
                }
                if row < last {
                    scale += h[(row + 1, row)].abs();
                }
            }
            if below <= f64::EPSILON * scale {
                let above = h[(row - 1, row)].abs();
                let apart = (before - here).abs();
                let [off_large, off_small] = [below.max(above), below.min(above)];
                let [large, small] = [here.abs().max(apart), here.abs().min(apart)];
                let sum = large + off_large;
                let bound = f64::EPSILON * (small * (large / sum));
                if off_small * (off_large / sum) <= bound.max(f64::MIN_POSITIVE) {
                    break;
                }
            }
            row -= 1;
        }
        row
    }

    /// Shifts: the eigenvalues of the trailing 2 x 2 matrix of the block, or exceptional ones.
    fn shifts(&self, first: usize, last: usize, iteration: usize) -> Shifts {
        let h = &self.h;
        let exceptional = |sum: f64, at: f64| {
            let diagonal = 0.75 * sum + at;
            [[diagonal, -0.4375 * sum], [sum, diagonal]]
        };
        let two = if iteration.is_multiple_of(2 * EXCEPTIONAL_EACH) {
            let sum = h[(last, last - 1)].abs() + h[(last - 1, last - 2)].abs();
            exceptional(sum, h[(last, last)])
        } else if iteration.is_multiple_of(EXCEPTIONAL_EACH) {
            let sum = h[(first + 1, first)].abs() + h[(first + 2, first + 1)].abs();
            exceptional(sum, h[(first, first)])
        } else {
            [
                [h[(last - 1, last - 1)], h[(last - 1, last)]],
                [h[(last, last - 1)], h[(last, last)]],
            ]
        };
        let [one, other] = eigenvalues_of_two(two);
        if one.im != 0.0 {
            return Shifts {
                real: [one.re, one.re],
                imaginary: one.im,
            };
        }
        // Both shifts are the real eigenvalue that is closer to the last entry.
        let is_nearer = (one.re - two[1][1]).abs() <= (other.re - two[1][1]).abs();
        let real = if is_nearer { one.re } else { other.re };
        Shifts {
            real: [real, real],
            imaginary: 0.0,
        }
    }

    /// First column of the doubly shifted matrix that begins at `row`, up to a factor.
    fn first_column(&self, row: usize, shifts: &Shifts) -> [f64; 3] {
        let h = &self.h;
        let ([first, second], imaginary) = (shifts.real, shifts.imaginary);
        let here = h[(row, row)];
        let scale = (here - second).abs() + imaginary.abs() + h[(row + 1, row)].abs();
        let below = h[(row + 1, row)] / scale;
        let column = [
            below * h[(row, row + 1)]
                + (here - first) * ((here - second) / scale)
                + imaginary * (imaginary / scale),
            below * (here + h[(row + 1, row + 1)] - first - second),
            below * h[(row + 2, row + 1)],
        ];
        let sum: f64 = column.iter().map(|number| number.abs()).sum();
        column.map(|number| number / sum)
    }

    /// One implicit double-shift QR sweep over the rows from `first` to `last`.
    fn sweep(&mut self, first: usize, last: usize, shifts: Shifts) {
        // The sweep can begin after two consecutive small subdiagonal entries.
        let mut begin = last - 2;
        let mut column = self.first_column(begin, &shifts);
        while begin > first {
            let h = &self.h;
            let around = h[(begin - 1, begin - 1)].abs()
                + h[(begin, begin)].abs()
                + h[(begin + 1, begin + 1)].abs();
            let left = h[(begin, begin - 1)].abs() * (column[1].abs() + column[2].abs());
            if left <= f64::EPSILON * column[0].abs() * around {
                break;
            }
            begin -= 1;
            column = self.first_column(begin, &shifts);
        }
        for row in begin..last {
            let rows = (last - row + 1).min(3);
            if row > begin {
                column = std::array::from_fn(|k| {
                    if k < rows {
                        self.h[(row + k, row - 1)]
                    } else {
                        0.0
                    }
                });
            }
            let (reflector, factor, left) = reflector(column);
            if row > begin {
                self.h[(row, row - 1)] = left;
                for k in 1..rows {
                    self.h[(row + k, row - 1)] = 0.0;
                }
            } else if row > first {
                self.h[(row, row - 1)] *= 1.0 - factor;
            }
            self.reflect(row, rows, [first, last], reflector, factor);
        }
    }

    /// Applies the reflection `1 - factor v v^T` to `rows` rows and columns from `row` on, within the block.
    fn reflect(
        &mut self,
        row: usize,
        rows: usize,
        [first, last]: [usize; 2],
        v: [f64; 3],
        factor: f64,
    ) {
        let h = &mut self.h;
        for column in row..=last {
            let sum: f64 = (0..rows).map(|k| v[k] * h[(row + k, column)]).sum();
            for k in 0..rows {
                h[(row + k, column)] -= factor * v[k] * sum;
            }
        }
        for other in first..=(row + 3).min(last) {
            let sum: f64 = (0..rows).map(|k| v[k] * h[(other, row + k)]).sum();
            for k in 0..rows {
                h[(other, row + k)] -= factor * v[k] * sum;
            }
        }
    }
}

/// Householder reflection `1 - factor v v^T` with `v[0] = 1` that maps three numbers to a multiple of the first unit
/// vector. Returns `v`, `factor` and that multiple.
fn reflector(numbers: [f64; 3]) -> ([f64; 3], f64, f64) {
    let [x, y, z] = numbers;
    let rest = libm::hypot(y, z);
    if rest == 0.0 {
        return ([1.0, 0.0, 0.0], 0.0, x);
    }
    let left = -libm::hypot(x, rest).copysign(x);
    let per = 1.0 / (x - left);
    ([1.0, y * per, z * per], (left - x) / left, left)
}

/// The eigenvalues of a 2 x 2 matrix.
fn eigenvalues_of_two([[a, b], [c, d]]: [[f64; 2]; 2]) -> [Complex<f64>; 2] {
    let scale = a.abs() + b.abs() + c.abs() + d.abs();
    if scale == 0.0 {
        return [Complex::from(0.0); 2];
    }
    let [a, b, c, d] = [a, b, c, d].map(|number| number / scale);
    let half = 0.5 * (a - d);
    let square = half * half + b * c;
    let root = square.abs().sqrt();
    let found = if square < 0.0 {
        [Complex::new(d + half, root), Complex::new(d + half, -root)]
    } else {
        // The eigenvalue farther from `d` is computed without cancellation. The other follows from it, because the
        // product of their distances from `d` is `-b c`.
        let far = half + root.copysign(half);
        let near = if far == 0.0 { 0.0 } else { -b * c / far };
        [Complex::from(d + far), Complex::from(d + near)]
    };
    found.map(|value| value * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(matrix: &DMatrix<f64>) -> Vec<[f64; 2]> {
        let values = eigenvalues(matrix).unwrap();
        let mut values: Vec<[f64; 2]> = values.iter().map(|value| [value.re, value.im]).collect();
        values.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        values
    }

    fn check(matrix: &DMatrix<f64>, expected: &[[f64; 2]], within: f64) {
        let found = sorted(matrix);
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.iter().zip(expected) {
            let distance = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(distance < within, "{found:?} for {expected:?}");
        }
    }

    /// The usual shifts do not change a cyclic permutation, so without exceptional shifts the iteration never
    /// terminates.
    #[test]
    fn the_eigenvalues_of_a_cyclic_permutation_are_the_roots_of_unity() {
        for size in [3, 4, 5, 8, 13] {
            let matrix =
                DMatrix::from_fn(size, size, |i, j| f64::from(u8::from(i == (j + 1) % size)));
            let mut expected: Vec<[f64; 2]> = (0..size)
                .map(|k| 2.0 * std::f64::consts::PI * k as f64 / size as f64)
                .map(|angle| [angle.cos(), angle.sin()])
                .collect();
            let found = eigenvalues(&matrix).unwrap();
            assert_eq!(found.len(), size);
            for value in found {
                let nearest = expected
                    .iter()
                    .position(|e| (e[0] - value.re).hypot(e[1] - value.im) < 1e-13);
                expected.remove(nearest.unwrap_or_else(|| panic!("{value} of {size}")));
            }
        }
    }

    #[test]
    fn eigenvalues_of_small_matrices_agree_with_closed_forms() {
        check(&DMatrix::zeros(0, 0), &[], 1e-15);
        check(&DMatrix::from_element(1, 1, -3.5), &[[-3.5, 0.0]], 1e-15);
        check(&DMatrix::zeros(3, 3), &[[0.0, 0.0]; 3], 1e-15);
        let oscillator = DMatrix::from_row_slice(2, 2, &[-0.4, -100.0, 1.0, 0.0]);
        let rate = (100.0 - 0.04_f64).sqrt();
        check(&oscillator, &[[-0.2, -rate], [-0.2, rate]], 1e-13);
        // The motion is strongly overdamped. Its slow eigenvalue must not have a cancellation error.
        let stiff = DMatrix::from_row_slice(2, 2, &[-1e8, -1.0, 1.0, 0.0]);
        let found = sorted(&stiff);
        assert!((found[0][0] / -1e8 - 1.0).abs() < 1e-15, "{found:?}");
        assert!((found[1][0] / -1e-8 - 1.0).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_no_eigenvalues() {
        for entry in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut matrix = DMatrix::identity(4, 4);
            matrix[(1, 2)] = entry;
            assert!(eigenvalues(&matrix).is_none());
        }
    }
}
