//! The frame: as a whole, and without its specimen.

use nalgebra::{Matrix3, SMatrix, Vector2, Vector3};

use super::plant::{Plant, SPECIMEN_KG};
use super::{CASES, RATE_HZ};
use crate::linear::LinearSystem;

/// Stiffness of the frame (N/m).
const STIFFNESS: Matrix3<f64> = Matrix3::new(
    26054883.88,
    -23133938.877,
    5937035.463,
    -23133938.877,
    32560774.186,
    -14419970.777,
    5937035.463,
    -14419970.777,
    9267275.506,
);
/// Mass of a storey (kg) and modal damping (1) of each case.
const STOREYS: [(f64, f64); CASES] = [
    (1000.0, 0.05),
    (1100.0, 0.04),
    (1300.0, 0.03),
    (1000.0, 0.03),
];

/// A frame whose first storey takes a force.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Displacements (m) and velocities (m/s) of the storeys; inputs are ground acceleration (m/s^2) and the force (N)
    /// that resists the first storey.
    system: LinearSystem<6, 2>,
    /// Row of the first storey's acceleration.
    of_state: SMatrix<f64, 1, 6>,
    of_inputs: SMatrix<f64, 1, 2>,
}

impl Frame {
    /// The whole frame of a case, counted from 0.
    pub(super) fn whole(case: usize) -> Self {
        Self::without(case, 0.0, 0.0, 0.0)
    }

    /// The frame without the specimen of a plant.
    pub(super) fn simulated(case: usize, plant: &Plant) -> Self {
        let (c, k) = (plant.damping_n_s_per_m(), plant.stiffness_n_per_m);
        Self::without(case, SPECIMEN_KG, c, k)
    }

    fn without(case: usize, mass_kg: f64, damping_n_s_per_m: f64, stiffness_n_per_m: f64) -> Self {
        let (storey_kg, damping_ratio) = STOREYS[case];
        let modes = (STIFFNESS / storey_kg).symmetric_eigen();
        let mut damping = Matrix3::zeros();
        for (shape, square) in modes.eigenvectors.column_iter().zip(&modes.eigenvalues) {
            damping +=
                shape * shape.transpose() * (2.0 * damping_ratio * libm::sqrt(*square) * storey_kg);
        }
        let mut stiffness = STIFFNESS;
        let mut masses = Vector3::repeat(storey_kg);
        masses[0] -= mass_kg;
        damping[(0, 0)] -= damping_n_s_per_m;
        stiffness[(0, 0)] -= stiffness_n_per_m;
        let per_mass = Matrix3::from_diagonal(&masses.map(|mass| 1.0 / mass));
        let mut a = SMatrix::<f64, 6, 6>::zeros();
        a.fixed_view_mut::<3, 3>(0, 3).fill_with_identity();
        a.fixed_view_mut::<3, 3>(3, 0)
            .copy_from(&(-per_mass * stiffness));
        a.fixed_view_mut::<3, 3>(3, 3)
            .copy_from(&(-per_mass * damping));
        let mut b = SMatrix::<f64, 6, 2>::zeros();
        // The ground moves the mass of the whole frame, that of the specimen included.
        b.fixed_view_mut::<3, 1>(3, 0)
            .copy_from(&(-per_mass * Vector3::repeat(storey_kg)));
        b.fixed_view_mut::<3, 1>(3, 1)
            .copy_from(&(-per_mass.column(0)));
        Self {
            system: LinearSystem::new(&a, &b, 1.0 / RATE_HZ),
            of_state: a.fixed_rows::<1>(3).into_owned(),
            of_inputs: b.fixed_rows::<1>(3).into_owned(),
        }
    }

    /// Displacements of the storeys (m).
    pub(super) fn displacements_m(&self) -> [f64; 3] {
        let state = &self.system.state;
        [state[0], state[1], state[2]]
    }

    /// Velocity (m/s) and acceleration (m/s^2) of the first storey under a ground acceleration (m/s^2) and a force (N).
    pub(super) fn first_storey(&self, ground_m_per_s2: f64, force_n: f64) -> (f64, f64) {
        let state = &self.system.state;
        let inputs = Vector2::new(ground_m_per_s2, force_n);
        let acceleration = self.of_state * state + self.of_inputs * inputs;
        (state[3], acceleration[0])
    }

    /// Takes a step.
    pub(super) fn step(&mut self, ground_m_per_s2: f64, force_n: f64) {
        self.system.step(&Vector2::new(ground_m_per_s2, force_n));
    }
}
