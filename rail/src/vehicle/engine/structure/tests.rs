//! Solutions against those of a dense solver.

use crate::math::dispatch::dispatch;
use fearless_simd::Level;
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
fn the_solution_equals_that_of_a_dense_solver() {
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
fn a_tree_has_no_fill_in_and_an_indefinite_matrix_is_detected() {
    let tree = matrix(&[(0, 1), (0, 2), (1, 3), (2, 4)]);
    let structure = Structure::new(&tree);
    assert_eq!(structure.couplings.len(), 4);
    // The outer bodies are eliminated before their neighbours.
    let blocks = structure.blocks(&tree);
    let coupling = |row: usize, column: usize| {
        let wanted = Coupling { row, column };
        let mut couplings = structure.couplings.iter();
        couplings.position(|coupling| *coupling == wanted)
    };
    for (row, column) in [(3, 1), (4, 2)] {
        let number = coupling(row, column).unwrap();
        let expected = Block::new(|i, j| tree[(N * row + i, N * column + j)]);
        assert_eq!(blocks.couplings[number], expected);
    }
    assert_eq!(coupling(3, 4), None);
    let mut blocks = structure.blocks(&(-tree));
    assert!(!dispatch!(Level::new(), simd => structure.factorise(simd, &mut blocks)));
}
