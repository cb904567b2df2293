//! Forces of all linear elements.

use fearless_simd::{Simd, f64x8};
use nalgebra::DMatrix;

use super::block::{Block, N, Vector, coordinates};

/// Stiffness and damping matrices of the vehicle, in blocks of bodies.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Springs {
    /// Row of each body.
    rows: Vec<Row>,
}

/// What acts on a body.
#[derive(Debug, Clone, PartialEq)]
enum Row {
    /// Bodies with springs and bodies with dashpots in rising order.
    Coupled {
        elastic: Vec<Acting>,
        viscous: Vec<Acting>,
    },
    /// A spring and a dashpot for each coordinate, without coupling, as under a rail.
    Uncoupled { stiffness: Vector, damping: Vector },
}

/// Forces of a body on another body or on itself.
#[derive(Debug, Clone, PartialEq)]
struct Acting {
    body: usize,
    /// Transposed: a row for each coordinate of the acting body, a column for each force.
    block: Block,
}

impl Row {
    fn new(on: usize, stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Self {
        let bodies = stiffness.nrows() / N;
        let acting = |matrix: &DMatrix<f64>| -> Vec<Acting> {
            let between = |body: usize| Acting {
                body,
                block: Block::new(|i, j| matrix[(N * on + j, N * body + i)]),
            };
            let acting = (0..bodies).map(between);
            acting.filter(|acting| !acting.block.is_zero()).collect()
        };
        let own = |matrix: &DMatrix<f64>| -> Vector {
            std::array::from_fn(|i| matrix[(N * on + i, N * on + i)])
        };
        let is_diagonal = |acting: &Acting| {
            let own = acting.block.diagonal();
            acting.body == on
                && acting.block == Block::new(|i, j| if i == j { own[i] } else { 0.0 })
        };
        let (elastic, viscous) = (acting(stiffness), acting(damping));
        if elastic.iter().chain(&viscous).all(is_diagonal) {
            Self::Uncoupled {
                stiffness: own(stiffness),
                damping: own(damping),
            }
        } else {
            Self::Coupled { elastic, viscous }
        }
    }
}

impl Springs {
    pub fn new(stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) -> Self {
        let rows = 0..stiffness.nrows() / N;
        Self {
            rows: rows.map(|on| Row::new(on, stiffness, damping)).collect(),
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
        for (on, (row, force)) in self.rows.iter().zip(forces).enumerate() {
            match row {
                Row::Coupled { elastic, viscous } => {
                    let elastic = products(simd, elastic, displacements);
                    let viscous = products(simd, viscous, velocities);
                    for (force, sum) in force.iter_mut().zip(coordinates(elastic + viscous)) {
                        *force += factor * sum;
                    }
                }
                Row::Uncoupled { stiffness, damping } => {
                    let (q, v) = (&displacements[on], &velocities[on]);
                    for i in 0..N {
                        force[i] += factor * (stiffness[i] * q[i] + damping[i] * v[i]);
                    }
                }
            }
        }
    }
}

/// Sum of the blocks times the motions of their bodies.
#[inline(always)]
fn products<S: Simd>(simd: S, acting: &[Acting], motions: &[Vector]) -> f64x8<S> {
    let mut sum = simd.splat_f64x8(0.0);
    for Acting { body, block } in acting {
        sum = block.add_product(simd, &motions[*body], sum);
    }
    sum
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use crate::math::dispatch::dispatch;
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
        let springs = Springs::new(&diagonal, &damping);
        let bodies = |acting: &[Acting]| acting.iter().map(|acting| acting.body).collect();
        let acting = |row: &Row| -> Option<[Vec<usize>; 2]> {
            match row {
                Row::Coupled { elastic, viscous } => Some([bodies(elastic), bodies(viscous)]),
                Row::Uncoupled { .. } => None,
            }
        };
        let acting: Vec<_> = springs.rows.iter().map(acting).collect();
        assert_eq!(acting, [Some([vec![0], vec![2]]), None, None]);
        let mut forces = [[0.0; N]; 3];
        let (q, v) = ([[1.5; N]; 3], [[0.5; N]; 3]);
        dispatch!(Level::new(), simd => springs.add(simd, -1.0, &q, &v, &mut forces));
        assert_eq!(
            forces,
            [[-3.5, -3.0, -3.0, -3.0, -3.0], [-3.0; N], [-3.0; N]]
        );
    }
}
