//! Symmetric positive definite equations in blocks of one body each, factorised along the order in which the bodies hang on one another.

use nalgebra::DMatrix;

use crate::vehicle::body::COORDINATES;

/// Coordinates of a body.
pub(super) const N: usize = COORDINATES.len();

/// One number for each coordinate of a body.
pub(super) type Vector = [f64; N];

/// One number for each pair of coordinates of two bodies.
pub(super) type Block = [[f64; N]; N];

/// A block that is not on the diagonal: its row and column.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Coupling {
    row: usize,
    column: usize,
}

/// A body and the couplings with those that are eliminated after it.
#[derive(Debug, Clone, PartialEq)]
struct Pivot {
    body: usize,
    /// Number of the coupling, whose row this body is, and the other body.
    couplings: Vec<(usize, usize)>,
    /// Where the elimination changes what is left: two of `couplings`, and the block of their bodies.
    fills: Vec<Fill>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Fill {
    /// Places in `couplings`.
    row: usize,
    column: usize,
    into: Place,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Diagonal(usize),
    Coupling(usize),
}

/// The order of elimination of bodies that are coupled in some pairs only: a body with the fewest couplings left goes first, so that
/// a tree (wheelsets, bogies, body) has none but its own.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Structure {
    bodies: usize,
    couplings: Vec<Coupling>,
    pivots: Vec<Pivot>,
}

/// The numbers of a structure: the matrix, or its factors in the same place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Blocks {
    pub diagonal: Vec<Block>,
    couplings: Vec<Block>,
}

impl Structure {
    /// For matrices whose blocks are zero where those of `pattern` are.
    pub fn new(pattern: &DMatrix<f64>) -> Self {
        let bodies = pattern.nrows() / N;
        let is_coupled = |i: usize, j: usize| {
            let block = pattern.view((N * i, N * j), (N, N));
            block.iter().any(|number| *number != 0.0)
        };
        let mut coupled: Vec<Vec<bool>> = (0..bodies)
            .map(|i| {
                (0..bodies)
                    .map(|j| i != j && (is_coupled(i, j) || is_coupled(j, i)))
                    .collect()
            })
            .collect();
        let mut left: Vec<usize> = (0..bodies).collect();
        let mut couplings = Vec::new();
        let mut orders = Vec::with_capacity(bodies);
        while !left.is_empty() {
            let degree = |body: &usize| left.iter().filter(|other| coupled[*body][**other]).count();
            // The last of equals: wheelsets, which follow the bodies in number, before them.
            let place = (0..left.len())
                .rev()
                .min_by_key(|place| degree(&left[*place]));
            let body = left.remove(place.unwrap_or_default());
            let others: Vec<usize> = left
                .iter()
                .copied()
                .filter(|other| coupled[body][*other])
                .collect();
            for i in &others {
                for j in &others {
                    coupled[*i][*j] |= i != j;
                }
            }
            let first = couplings.len();
            couplings.extend(others.iter().map(|column| Coupling {
                row: body,
                column: *column,
            }));
            orders.push((body, first, others));
        }
        let number_of = |a: usize, b: usize| {
            let found = couplings
                .iter()
                .position(|coupling| (coupling.row, coupling.column) == (a, b));
            found.map(Place::Coupling)
        };
        let pivots = orders
            .into_iter()
            .map(|(body, first, others)| {
                let mut fills = Vec::new();
                for (row, i) in others.iter().enumerate() {
                    for (column, j) in others.iter().enumerate() {
                        // Every pair once, as the later elimination has it.
                        let into = if i == j {
                            Some(Place::Diagonal(*i))
                        } else {
                            number_of(*i, *j)
                        };
                        fills.extend(into.map(|into| Fill { row, column, into }));
                    }
                }
                let couplings = others
                    .iter()
                    .enumerate()
                    .map(|(k, other)| (first + k, *other))
                    .collect();
                Pivot {
                    body,
                    couplings,
                    fills,
                }
            })
            .collect();
        Self {
            bodies,
            couplings,
            pivots,
        }
    }

    /// The blocks of a matrix.
    pub fn blocks(&self, matrix: &DMatrix<f64>) -> Blocks {
        let block = |row: usize, column: usize| -> Block {
            std::array::from_fn(|i| std::array::from_fn(|j| matrix[(N * row + i, N * column + j)]))
        };
        Blocks {
            diagonal: (0..self.bodies).map(|body| block(body, body)).collect(),
            couplings: self
                .couplings
                .iter()
                .map(|place| block(place.row, place.column))
                .collect(),
        }
    }

    /// `result -= matrix * vector` for a matrix whose couplings mirror each other.
    #[inline(always)]
    pub fn subtract_product(&self, matrix: &Blocks, vector: &[Vector], result: &mut [Vector]) {
        for ((block, x), y) in matrix.diagonal.iter().zip(vector).zip(result.iter_mut()) {
            for (row, y) in block.iter().zip(y) {
                *y -= dot(row, x);
            }
        }
        for (block, place) in matrix.couplings.iter().zip(&self.couplings) {
            let across = vector[place.column];
            let along = vector[place.row];
            for (i, row) in block.iter().enumerate() {
                result[place.row][i] -= dot(row, &across);
                for (j, number) in row.iter().enumerate() {
                    result[place.column][j] -= number * along[i];
                }
            }
        }
    }

    /// Factorises in place, `L D L^T` of each body and what of it the others keep; whether all pivots are positive.
    #[inline(always)]
    pub fn factorise(&self, blocks: &mut Blocks) -> bool {
        let mut is_positive = true;
        for pivot in &self.pivots {
            let factor = &mut blocks.diagonal[pivot.body];
            is_positive &= factorise(factor);
            let factor = *factor;
            for (number, _) in &pivot.couplings {
                forward(&factor, &mut blocks.couplings[*number]);
            }
            for fill in &pivot.fills {
                let right = blocks.couplings[pivot.couplings[fill.column].0];
                let mut left = blocks.couplings[pivot.couplings[fill.row].0];
                for (k, row) in left.iter_mut().enumerate() {
                    *row = row.map(|number| number * factor[k][k]);
                }
                let into = match fill.into {
                    Place::Diagonal(body) => &mut blocks.diagonal[body],
                    Place::Coupling(number) => &mut blocks.couplings[number],
                };
                for (left, right) in left.iter().zip(&right) {
                    for (into, left) in into.iter_mut().zip(left) {
                        for (into, right) in into.iter_mut().zip(right) {
                            *into -= left * right;
                        }
                    }
                }
            }
        }
        is_positive
    }

    /// Solves with the factors, in place of the right-hand side.
    #[inline(always)]
    pub fn solve(&self, factors: &Blocks, vector: &mut [Vector]) {
        for pivot in &self.pivots {
            let factor = &factors.diagonal[pivot.body];
            let mut own = vector[pivot.body];
            for i in 1..N {
                for j in 0..i {
                    own[i] -= factor[i][j] * own[j];
                }
            }
            for (i, number) in own.iter_mut().enumerate() {
                *number *= factor[i][i];
            }
            for (number, other) in &pivot.couplings {
                for (row, own) in factors.couplings[*number].iter().zip(own) {
                    for (left, number) in vector[*other].iter_mut().zip(row) {
                        *left -= number * own;
                    }
                }
            }
            vector[pivot.body] = own;
        }
        for pivot in self.pivots.iter().rev() {
            let factor = &factors.diagonal[pivot.body];
            let mut own = vector[pivot.body];
            for (number, other) in &pivot.couplings {
                let other = &vector[*other];
                for (i, row) in factors.couplings[*number].iter().enumerate() {
                    own[i] -= factor[i][i] * dot(row, other);
                }
            }
            for i in (0..N).rev() {
                for j in i + 1..N {
                    own[i] -= factor[j][i] * own[j];
                }
            }
            vector[pivot.body] = own;
        }
    }
}

#[inline(always)]
fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `L D L^T` of the lower half: unit `L` below the diagonal, `1/D` on it.
#[inline(always)]
fn factorise(block: &mut Block) -> bool {
    let mut is_positive = true;
    for j in 0..N {
        let mut scaled = [0.0; N];
        let mut pivot = block[j][j];
        for k in 0..j {
            // `1/D` lies on the diagonal, so that the scaled row was kept in the upper half.
            scaled[k] = block[k][j];
            pivot -= block[j][k] * scaled[k];
        }
        is_positive &= pivot > 0.0;
        let inverse = 1.0 / pivot;
        block[j][j] = inverse;
        for i in j + 1..N {
            let mut number = block[i][j];
            for k in 0..j {
                number -= block[i][k] * scaled[k];
            }
            block[j][i] = number;
            block[i][j] = number * inverse;
        }
    }
    is_positive
}

/// `L^-1` times a block, in place.
#[inline(always)]
fn forward(factor: &Block, block: &mut Block) {
    for i in 1..N {
        for j in 0..i {
            let above = block[j];
            for (number, above) in block[i].iter_mut().zip(above) {
                *number -= factor[i][j] * above;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    /// A positive definite matrix of five bodies with the couplings of a ring and a tree.
    fn matrix(pairs: &[(usize, usize)]) -> DMatrix<f64> {
        let mut matrix = DMatrix::from_diagonal_element(5 * N, 5 * N, 40.0);
        let mut number = 0.0_f64;
        let mut next = || {
            number += 1.0;
            (7.3 * number).sin()
        };
        for body in 0..5 {
            for i in 0..N {
                for j in 0..i {
                    let value = next();
                    matrix[(N * body + i, N * body + j)] = value;
                    matrix[(N * body + j, N * body + i)] = value;
                }
            }
        }
        for (a, b) in pairs {
            for i in 0..N {
                for j in 0..N {
                    let value = next();
                    matrix[(N * a + i, N * b + j)] = value;
                    matrix[(N * b + j, N * a + i)] = value;
                }
            }
        }
        matrix
    }

    #[test]
    fn it_solves_what_a_dense_solver_solves() {
        let tree: &[(usize, usize)] = &[(0, 1), (0, 2), (1, 3), (2, 4)];
        let ring: &[(usize, usize)] = &[(0, 1), (1, 2), (2, 3), (3, 4), (4, 0), (1, 4)];
        for pairs in [tree, ring, &[]] {
            let matrix = matrix(pairs);
            let structure = Structure::new(&matrix);
            let blocks = structure.blocks(&matrix);
            let right: Vec<Vector> = (0..5)
                .map(|body| std::array::from_fn(|i| f64::from((3 * body + i as i32) % 7) - 2.5))
                .collect();
            let dense = DVector::from_iterator(5 * N, right.iter().flatten().copied());
            let expected = matrix.clone().cholesky().unwrap().solve(&dense);
            let mut found = right.clone();
            let mut factors = blocks.clone();
            assert!(structure.factorise(&mut factors));
            structure.solve(&factors, &mut found);
            for (found, expected) in found.iter().flatten().zip(expected.iter()) {
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
            let mut rest = right;
            structure.subtract_product(&blocks, &found, &mut rest);
            assert!(rest.iter().flatten().all(|number| number.abs() < 1e-12));
        }
    }

    #[test]
    fn a_tree_fills_nothing_and_an_indefinite_matrix_is_told() {
        let tree = matrix(&[(0, 1), (0, 2), (1, 3), (2, 4)]);
        let structure = Structure::new(&tree);
        assert_eq!(structure.couplings.len(), 4);
        let mut blocks = structure.blocks(&(-tree));
        assert!(!structure.factorise(&mut blocks));
    }
}
