//! Forces of all linear elements.

use fearless_simd::Simd;
use nalgebra::DMatrix;

use super::block::{Block, N, Vector, coordinates};

/// Stiffness and damping matrices of the vehicle, in blocks of bodies.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Springs {
    /// Nonzero blocks in the row of each body.
    rows: Vec<Vec<Acting>>,
}

/// Forces of a body on another body or on itself.
#[derive(Debug, Clone, PartialEq)]
struct Acting {
    body: usize,
    /// Transposed: a row for each coordinate of the acting body, a column for each force.
    stiffness: Block,
    damping: Block,
}

impl Springs {
    pub fn new(stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Self {
        let bodies = stiffness.nrows() / N;
        let row = |on: usize| {
            let between = move |body: usize| {
                let block =
                    |matrix: &DMatrix<f64>| Block::new(|i, j| matrix[(N * on + j, N * body + i)]);
                Acting {
                    body,
                    stiffness: block(stiffness),
                    damping: block(damping),
                }
            };
            let acts = |acting: &Acting| !acting.stiffness.is_zero() || !acting.damping.is_zero();
            (0..bodies).map(between).filter(acts).collect()
        };
        Self {
            rows: (0..bodies).map(row).collect(),
        }
    }

    /// Adds `factor * (K * displacements + C * velocities)` to the forces.
    #[inline(always)]
    pub fn add<S: Simd>(
        &self,
        simd: S,
        factor: f64,
        displacements: &[Vector],
        velocities: &[Vector],
        forces: &mut [Vector],
    ) {
        for (row, force) in self.rows.iter().zip(forces) {
            let (mut elastic, mut viscous) = (simd.splat_f64x8(0.0), simd.splat_f64x8(0.0));
            for Acting {
                body,
                stiffness,
                damping,
            } in row
            {
                elastic = stiffness.add_product(simd, &displacements[*body], elastic);
                viscous = damping.add_product(simd, &velocities[*body], viscous);
            }
            for (force, sum) in force.iter_mut().zip(coordinates(elastic + viscous)) {
                *force += factor * sum;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};
    use nalgebra::DVector;

    use super::*;

    #[test]
    fn forces_equal_those_of_dense_matrices() {
        let stiffness = DMatrix::from_fn(3 * N, 3 * N, |i, j| (1.7 * (i * j) as f64).sin());
        let damping = DMatrix::from_fn(3 * N, 3 * N, |i, j| {
            // The last body has no dashpots.
            if i.max(j) < 2 * N {
                (2.3 * (i + j) as f64).cos()
            } else {
                0.0
            }
        });
        let springs = Springs::new(&stiffness, &damping);
        let vectors = |scale: f64| -> Vec<Vector> {
            let number = |body: usize, i: usize| (scale * (N * body + i) as f64).sin();
            (0..3)
                .map(|body| std::array::from_fn(|i| number(body, i)))
                .collect()
        };
        let (q, v) = (vectors(0.7), vectors(1.1));
        let mut forces = vectors(0.3);
        let dense =
            |vectors: &[Vector]| DVector::from_iterator(3 * N, vectors.iter().flatten().copied());
        let expected = dense(&forces) - stiffness * dense(&q) - damping * dense(&v);
        dispatch!(Level::new(), simd => springs.add(simd, -1.0, &q, &v, &mut forces));
        assert!((dense(&forces) - expected).amax() < 1e-13);
    }

    #[test]
    fn only_coupled_bodies_act_on_each_other() {
        let diagonal = DMatrix::from_diagonal_element(3 * N, 3 * N, 2.0);
        let mut damping = DMatrix::zeros(3 * N, 3 * N);
        damping[(0, 2 * N)] = 1.0;
        let acting = |springs: &Springs| -> Vec<Vec<usize>> {
            let bodies = |row: &Vec<Acting>| row.iter().map(|acting| acting.body).collect();
            springs.rows.iter().map(bodies).collect()
        };
        let springs = Springs::new(&diagonal, &damping);
        assert_eq!(acting(&springs), [vec![0, 2], vec![1], vec![2]]);
    }
}
