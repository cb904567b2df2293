//! Sparse block factorisation of symmetric positive definite equations, with one block per body.

use fearless_simd::Simd;
use nalgebra::DMatrix;

use super::block::{Block, N, Vector, coordinates, subtract};

/// Row and column of an off-diagonal block.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Coupling {
    row: usize,
    column: usize,
}

/// A body and its couplings with bodies that are eliminated later.
#[derive(Debug, Clone, PartialEq)]
struct Pivot {
    body: usize,
    /// Index of each coupling in the row of this body, and the other body.
    couplings: Vec<(usize, usize)>,
    /// Blocks of the remaining matrix that the elimination changes.
    fills: Vec<Fill>,
}

/// An update of a block by the product of two couplings.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Fill {
    /// Index in the pivot's `couplings`.
    row: usize,
    /// Index in the pivot's `couplings`.
    column: usize,
    target: Target,
}

/// Index of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Target {
    Diagonal(usize),
    Coupling(usize),
}

/// Elimination order of sparsely coupled bodies. The body with the fewest remaining couplings is eliminated first, so
/// that a tree (wheelsets, bogies, body) has no fill-in.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Structure {
    bodies: usize,
    couplings: Vec<Coupling>,
    pivots: Vec<Pivot>,
}

/// Blocks of a matrix, or of its factors after factorisation in place.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Blocks {
    /// Diagonal blocks; after factorisation, the inverse of each pivot.
    pub diagonal: Vec<Block>,
    pub couplings: Vec<Block>,
    /// Factors only: transpose of each coupling times the inverse of its pivot.
    pub carried: Vec<Block>,
}

impl Blocks {
    /// Copies a matrix of the same structure.
    #[inline(always)]
    pub fn set(&mut self, matrix: &Self) {
        self.diagonal.copy_from_slice(&matrix.diagonal);
        self.couplings.copy_from_slice(&matrix.couplings);
    }
}

impl Structure {
    /// Returns the structure for matrices that are zero in every block in which `pattern` is zero.
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
            // Takes the last of several minima, so that wheelsets, which have the highest indices, come first.
            let next = (0..left.len())
                .rev()
                .min_by_key(|index| degree(&left[*index]));
            let body = left.remove(next.unwrap_or_default());
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
        let find = |a: usize, b: usize| {
            let found = couplings
                .iter()
                .position(|coupling| (coupling.row, coupling.column) == (a, b));
            found.map(Target::Coupling)
        };
        let pivots = orders
            .into_iter()
            .map(|(body, first, others)| {
                let mut fills = Vec::new();
                for (row, i) in others.iter().enumerate() {
                    for (column, j) in others.iter().enumerate() {
                        // Each pair is stored once, in the order of elimination.
                        let target = if i == j {
                            Some(Target::Diagonal(*i))
                        } else {
                            find(*i, *j)
                        };
                        fills.extend(target.map(|target| Fill {
                            row,
                            column,
                            target,
                        }));
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

    /// Returns the blocks of a matrix.
    pub fn blocks(&self, matrix: &DMatrix<f64>) -> Blocks {
        let block =
            |row: usize, column: usize| Block::new(|i, j| matrix[(N * row + i, N * column + j)]);
        Blocks {
            diagonal: (0..self.bodies).map(|body| block(body, body)).collect(),
            couplings: self
                .couplings
                .iter()
                .map(|coupling| block(coupling.row, coupling.column))
                .collect(),
            carried: vec![Block::ZERO; self.couplings.len()],
        }
    }

    /// Factorises in place. Returns true if all pivots are positive.
    ///
    /// Eliminating a body with block `A` and couplings `C` subtracts `C^T A^-1 C` from the remaining matrix.
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
                let right = pivot.couplings[fill.column].0;
                match fill.target {
                    Target::Diagonal(body) => {
                        diagonal[body].subtract_product(simd, left, &couplings[right]);
                    }
                    Target::Coupling(number) => {
                        let right = couplings[right];
                        couplings[number].subtract_product(simd, left, &right);
                    }
                }
            }
        }
        is_positive
    }

    /// Solves in place: replaces the right-hand side by the solution.
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

#[cfg(test)]
mod tests;
