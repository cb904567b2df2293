//! Linear equations with two right sides.

use fearless_simd::{Simd, SimdBase, dispatch, f64x4};

use crate::math::number::load;

/// Number of columns of a matrix for `count` unknowns: the coefficients, both right sides, and padding to fill vectors.
pub(super) fn columns(count: usize) -> usize {
    (count + 2).next_multiple_of(4)
}

/// Solves for `count` unknowns by Gaussian elimination; the solutions replace the right sides.
///
/// Rows are not exchanged: the largest coefficient of each row is the one on the diagonal.
pub(super) fn solve(matrix: &mut [f64], count: usize) {
    dispatch!(crate::math::level(), simd => eliminate(simd, matrix, count));
}

#[inline(always)]
fn eliminate<S: Simd>(simd: S, matrix: &mut [f64], count: usize) {
    let columns = columns(count);
    for pivot in 0..count {
        let (above, below) = matrix.split_at_mut((pivot + 1) * columns);
        // Whole vectors are subtracted; what they change before the pivot is not read again.
        let start = pivot / 4 * 4;
        let pivot_row = &above[pivot * columns..];
        let reciprocal = 1.0 / pivot_row[pivot];
        let (pivots, _) = pivot_row[start..].as_chunks::<4>();
        for row in below.chunks_exact_mut(columns) {
            let factor = simd.splat_f64x4(-row[pivot] * reciprocal);
            let (values, _) = row[start..].as_chunks_mut::<4>();
            for (value, term) in values.iter_mut().zip(pivots) {
                let sum: f64x4<S> = simd.mul_add_f64x4(load(simd, term), factor, load(simd, value));
                sum.store_slice(value);
            }
        }
    }
    for row in (0..count).rev() {
        let at = row * columns;
        let (mut first, mut second) = (matrix[at + count], matrix[at + count + 1]);
        for column in row + 1..count {
            let (factor, known) = (matrix[at + column], column * columns + count);
            first -= factor * matrix[known];
            second -= factor * matrix[known + 1];
        }
        let reciprocal = 1.0 / matrix[at + row];
        matrix[at + count] = first * reciprocal;
        matrix[at + count + 1] = second * reciprocal;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_satisfy_the_equations() {
        for count in 1..13 {
            let columns = columns(count);
            let coefficient =
                |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + 0.01 * j as f64;
            let mut matrix = vec![0.0; count * columns];
            for i in 0..count {
                for j in 0..count {
                    matrix[i * columns + j] = coefficient(i, j);
                }
                matrix[i * columns + count] = i as f64;
                matrix[i * columns + count + 1] = 1.0;
            }
            solve(&mut matrix, count);
            for i in 0..count {
                let sum = |side: usize| -> f64 {
                    (0..count)
                        .map(|j| coefficient(i, j) * matrix[j * columns + count + side])
                        .sum()
                };
                assert!((sum(0) - i as f64).abs() < 1e-11, "{count}");
                assert!((sum(1) - 1.0).abs() < 1e-11, "{count}");
            }
        }
    }
}
