//! Elimination and solution against those of whole blocks.

use fearless_simd::Level;
use nalgebra::DMatrix;

use super::*;
use crate::math::dispatch::dispatch;
use crate::vehicle::engine::columns::Products;
use crate::vehicle::engine::structure::Structure;

/// Directions of patches on the left and the right wheel, with their weights.
const PATCHES: [(usize, Vector, f64); 3] = [
    (0, [0.3, -0.9, 0.8, 0.0, 0.1], 2.0),
    (1, [-0.2, -1.1, -0.7, 0.0, 0.2], 3.0),
    (1, [0.9, 0.4, 0.5, -0.3, 0.6], 1.5),
];
const OWN: [f64; RAILS] = [3.0, 4.0, 5.0, 6.0];

fn wheelset() -> DMatrix<f64> {
    DMatrix::from_fn(N, N, |i, j| if i == j { 9.0 } else { 0.1 * (i + j) as f64 })
}

/// Rails and wheelset with the patches, as one matrix: the rails first.
fn matrix() -> DMatrix<f64> {
    let mut matrix = DMatrix::identity(2 * N, 2 * N);
    for (i, own) in OWN.iter().enumerate() {
        matrix[(i, i)] = *own;
    }
    matrix.view_mut((N, N), (N, N)).copy_from(&wheelset());
    for (side, direction, weight) in PATCHES {
        let mut relative = [0.0; 2 * N];
        relative[N..].copy_from_slice(&direction);
        for i in 0..2 {
            relative[2 * side + i] = -direction[i];
        }
        for i in 0..2 * N {
            for j in 0..2 * N {
                matrix[(i, j)] += weight * relative[i] * relative[j];
            }
        }
    }
    matrix
}

#[inline(always)]
fn with_patches<S: Simd>(simd: S) -> (RailEquations, Block) {
    let wheelset = wheelset();
    let mut block = Block::new(|i, j| wheelset[(i, j)]);
    let mut rails = RailEquations::uncoupled(OWN);
    let mut products = Products::new(simd, &block);
    for (side, direction, weight) in PATCHES {
        let weighted = products.add(&direction, weight, [0, 1, 2, 3, 4]);
        rails.add(simd, side, [direction[0], direction[1]], &weighted);
    }
    products.write(&mut block);
    (rails, block)
}

#[test]
fn the_solution_equals_that_of_whole_blocks() {
    let right = [[0.5, -2.0, 1.5, 3.0, 0.0], [1.0, 2.0, -1.0, 0.3, -0.7]];
    let matrix = matrix();
    let structure = Structure::new(&matrix);
    let mut factors = structure.blocks(&matrix);
    let mut expected = right;
    let [mut on_rails, mut on_wheelset] = right;
    dispatch!(Level::new(), simd => {
        assert!(structure.factorise(simd, &mut factors));
        structure.solve(simd, &factors, &mut expected);
        let (mut rails, mut block) = with_patches(simd);
        assert!(rails.eliminate(simd, &mut block) & block.invert(simd));
        rails.solve_rails(simd, &mut on_rails, &mut on_wheelset);
        on_wheelset = crate::vehicle::engine::block::coordinates(block.product(simd, &on_wheelset));
        rails.follow_wheelset(simd, &mut on_rails, &on_wheelset);
    });
    for (found, expected) in [on_rails, on_wheelset].iter().zip(&expected) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
        }
    }
}

#[test]
fn rails_with_a_pivot_that_is_not_positive_are_detected() {
    for coordinate in 0..RAILS {
        for (number, is_positive) in [(1e-3, true), (0.0, false), (-1e-3, false)] {
            let mut own = OWN;
            own[coordinate] = number;
            let mut rails = RailEquations::uncoupled(own);
            let mut block = Block::ZERO;
            let found = dispatch!(Level::new(), simd => rails.eliminate(simd, &mut block));
            assert_eq!(found, is_positive, "{coordinate} {number}");
        }
    }
}
