//! Symmetric positive definite equations in blocks of one body each, factorised along the order in which the bodies hang on one another.

use fearless_simd::{Simd, f64x8};
use nalgebra::DMatrix;

use super::block::{Block, N, Vector, coordinates};

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
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Blocks {
    /// Factorised, the inverse of each body's block when its turn comes.
    pub diagonal: Vec<Block>,
    pub couplings: Vec<Block>,
    /// Of the factors: each coupling's transpose times the inverse.
    pub carried: Vec<Block>,
}

impl Blocks {
    /// Takes the numbers of a matrix of the same structure.
    #[inline(always)]
    pub fn set(&mut self, matrix: &Self) {
        self.diagonal.copy_from_slice(&matrix.diagonal);
        self.couplings.copy_from_slice(&matrix.couplings);
    }
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

    /// Number of the coupling with this row and column.
    pub fn coupling(&self, row: usize, column: usize) -> Option<usize> {
        let place = Coupling { row, column };
        self.couplings
            .iter()
            .position(|coupling| *coupling == place)
    }

    /// The blocks of a matrix.
    pub fn blocks(&self, matrix: &DMatrix<f64>) -> Blocks {
        let block =
            |row: usize, column: usize| Block::new(|i, j| matrix[(N * row + i, N * column + j)]);
        Blocks {
            diagonal: (0..self.bodies).map(|body| block(body, body)).collect(),
            couplings: self
                .couplings
                .iter()
                .map(|place| block(place.row, place.column))
                .collect(),
            carried: vec![Block::ZERO; self.couplings.len()],
        }
    }

    /// Factorises in place; whether all pivots are positive.
    ///
    /// Each body in its turn: with its block `A` and a coupling `C`, `C^T A^-1 C` leaves what is left.
    #[inline(always)]
    pub fn factorise<S: Simd>(&self, simd: S, blocks: &mut Blocks) -> bool {
        let Blocks {
            diagonal,
            couplings,
            carried,
        } = blocks;
        let mut is_positive = true;
        for pivot in &self.pivots {
            let inverse = &mut diagonal[pivot.body];
            is_positive &= inverse.invert(simd);
            for (number, _) in &pivot.couplings {
                carried[*number].set_transposed_product(simd, &couplings[*number], inverse);
            }
            for fill in &pivot.fills {
                let left = &carried[pivot.couplings[fill.row].0];
                let right = couplings[pivot.couplings[fill.column].0];
                let into = match fill.into {
                    Place::Diagonal(body) => &mut diagonal[body],
                    Place::Coupling(number) => &mut couplings[number],
                };
                into.subtract_product(simd, left, &right);
            }
        }
        is_positive
    }

    /// Solves with the factors, in place of the right-hand side.
    #[inline(always)]
    pub fn solve<S: Simd>(&self, simd: S, factors: &Blocks, vector: &mut [Vector]) {
        let Blocks {
            diagonal,
            couplings,
            carried,
        } = factors;
        for pivot in &self.pivots {
            let own = coordinates(diagonal[pivot.body].product(simd, &vector[pivot.body]));
            vector[pivot.body] = own;
            for (number, other) in &pivot.couplings {
                subtract(&mut vector[*other], couplings[*number].product(simd, &own));
            }
        }
        for pivot in self.pivots.iter().rev() {
            let mut sum = simd.splat_f64x8(0.0);
            for (number, other) in &pivot.couplings {
                sum = carried[*number].add_product(simd, &vector[*other], sum);
            }
            subtract(&mut vector[pivot.body], sum);
        }
    }
}

#[inline(always)]
fn subtract<S: Simd>(vector: &mut Vector, row: f64x8<S>) {
    for (number, by) in vector.iter_mut().zip(coordinates(row)) {
        *number -= by;
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};
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
            let right: Vec<Vector> = (0..5)
                .map(|body| std::array::from_fn(|i| f64::from((3 * body + i as i32) % 7) - 2.5))
                .collect();
            let dense = DVector::from_iterator(5 * N, right.iter().flatten().copied());
            let expected = matrix.clone().cholesky().unwrap().solve(&dense);
            let mut found = right;
            let mut factors = structure.blocks(&matrix);
            let is_positive = dispatch!(Level::new(), simd => {
                let is_positive = structure.factorise(simd, &mut factors);
                structure.solve(simd, &factors, &mut found);
                is_positive
            });
            assert!(is_positive);
            for (found, expected) in found.iter().flatten().zip(expected.iter()) {
                assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            }
        }
    }

    #[test]
    fn a_tree_fills_nothing_and_an_indefinite_matrix_is_told() {
        let tree = matrix(&[(0, 1), (0, 2), (1, 3), (2, 4)]);
        let structure = Structure::new(&tree);
        assert_eq!(structure.couplings.len(), 4);
        let mut blocks = structure.blocks(&(-tree));
        assert!(!dispatch!(Level::new(), simd => structure.factorise(simd, &mut blocks)));
    }
}
