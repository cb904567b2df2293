//! Dense square matrices and their factorisation by Gaussian elimination with partial pivoting.

/// Square matrix, stored by rows.
#[derive(Clone, Debug)]
pub(crate) struct Matrix {
    size: usize,
    entries: Vec<f64>,
}

impl Matrix {
    pub(crate) fn zeros(size: usize) -> Self {
        Self {
            size,
            entries: vec![0.0; size * size],
        }
    }

    pub(crate) fn size(&self) -> usize {
        self.size
    }

    pub(crate) fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.size..][..self.size]
    }

    pub(crate) fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.entries[row * self.size..][..self.size]
    }

    /// Adds to one entry.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.size + column] += value;
    }

    /// Writes the product with a vector.
    pub(crate) fn times(&self, vector: &[f64], product: &mut [f64]) {
        for (row, product) in product.iter_mut().enumerate() {
            *product = self::product(self.row(row), vector);
        }
    }

    /// Returns two rows; `upper` is above `lower`.
    fn two_rows(&mut self, upper: usize, lower: usize) -> (&mut [f64], &mut [f64]) {
        let (head, tail) = self.entries.split_at_mut(lower * self.size);
        (
            &mut head[upper * self.size..][..self.size],
            &mut tail[..self.size],
        )
    }
}

/// Factors `P A = L U` of a matrix; `L` has ones on its diagonal.
#[derive(Clone, Debug)]
pub(crate) struct Factors {
    /// `L` below the diagonal, `U` on and above it.
    matrix: Matrix,
    /// For each row, the row with which it was exchanged, in order.
    exchanges: Vec<usize>,
}

impl Factors {
    /// Factorises a matrix.
    pub(crate) fn new(matrix: Matrix) -> Self {
        let mut factors = Self {
            exchanges: vec![0; matrix.size],
            matrix,
        };
        factors.eliminate();
        factors
    }

    /// Factorises the matrix that `fill` writes; reuses the memory of the old factors.
    pub(crate) fn replace(&mut self, fill: impl FnOnce(&mut Matrix)) {
        fill(&mut self.matrix);
        self.eliminate();
    }

    /// True if the matrix has no inverse. [`Self::solve`] then returns infinities or NaN.
    pub(crate) fn is_singular(&self) -> bool {
        (0..self.matrix.size).any(|k| self.matrix.row(k)[k] == 0.0)
    }

    fn eliminate(&mut self) {
        let size = self.matrix.size;
        for k in 0..size {
            let magnitude = |row: usize| self.matrix.row(row)[k].abs();
            let pivot = (k..size).fold(k, |best, row| {
                if magnitude(row) >= magnitude(best) {
                    row
                } else {
                    best
                }
            });
            self.exchanges[k] = pivot;
            if pivot != k {
                let (upper, lower) = self.matrix.two_rows(k, pivot);
                upper.swap_with_slice(lower);
            }
            for row in k + 1..size {
                let (top, below) = self.matrix.two_rows(k, row);
                // Most entries of a vehicle's matrix are zero: skip them.
                if below[k] == 0.0 {
                    continue;
                }
                let factor = below[k] / top[k];
                below[k] = factor;
                for (entry, top_entry) in below[k + 1..].iter_mut().zip(&top[k + 1..]) {
                    *entry -= factor * top_entry;
                }
            }
        }
    }

    /// Replaces the right side by the solution.
    pub(crate) fn solve(&self, right_side: &mut [f64]) {
        for (k, exchange) in self.exchanges.iter().enumerate() {
            right_side.swap(k, *exchange);
        }
        for row in 0..self.matrix.size {
            right_side[row] -= product(&self.matrix.row(row)[..row], &right_side[..row]);
        }
        for row in (0..self.matrix.size).rev() {
            let entries = self.matrix.row(row);
            let known = product(&entries[row + 1..], &right_side[row + 1..]);
            right_side[row] = (right_side[row] - known) / entries[row];
        }
    }
}

/// Scalar product of two vectors of equal length. Four sums side by side do not wait for each other.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let (fours, other_fours) = (a.chunks_exact(4), b.chunks_exact(4));
    let left = fours.remainder().iter().zip(other_fours.remainder());
    let left: f64 = left.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 4];
    for (a, b) in fours.zip(other_fours) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    left + (sums[0] + sums[1]) + (sums[2] + sums[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const N: usize>(rows: [[f64; N]; N]) -> Matrix {
        Matrix {
            size: N,
            entries: rows.concat(),
        }
    }

    #[test]
    fn solution_satisfies_the_equations() {
        // The first pivot is zero and the second row has the largest entry.
        let matrix = matrix([[0.0, 2.0, 1.0], [4.0, -2.0, 0.5], [1.0, 0.0, 3.0]]);
        let expected = [1.5, -2.0, 0.25];
        let mut solution = [0.0; 3];
        matrix.times(&expected, &mut solution);
        assert_eq!(solution, [-3.75, 10.125, 2.25]);
        Factors::new(matrix).solve(&mut solution);
        for (actual, expected) in solution.iter().zip(expected) {
            assert!((actual - expected).abs() < 1e-15, "{solution:?}");
        }
    }

    #[test]
    fn a_matrix_without_inverse_is_singular() {
        let dependent = Factors::new(matrix([[1.0, 2.0], [2.0, 4.0]]));
        assert!(dependent.is_singular());
        let mut right_side = [1.0, 1.0];
        dependent.solve(&mut right_side);
        assert!(!right_side[1].is_finite());
        assert!(!Factors::new(matrix([[1.0, 2.0], [2.0, 4.1]])).is_singular());
    }

    #[test]
    fn replaced_factors_are_those_of_the_new_matrix() {
        let mut factors = Factors::new(matrix([[0.0, 1.0], [1.0, 0.0]]));
        factors.replace(|entries| {
            entries.row_mut(0).copy_from_slice(&[2.0, 0.0]);
            entries.row_mut(1).copy_from_slice(&[0.0, 4.0]);
        });
        let mut right_side = [1.0, 1.0];
        factors.solve(&mut right_side);
        assert_eq!(right_side, [0.5, 0.25]);
    }
}
