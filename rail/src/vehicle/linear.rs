//! Linear equations of motion `M q'' + C q' + K q = f`, with one more state for each dashpot in series with a spring.

use dashpot_core::DamperParameters;
use dashpot_core::characteristic::Characteristic;
use nalgebra::{DMatrix, DVector, Matrix3, RowDVector, Vector3};

use super::body::{Body, COORDINATES};
use super::element::{Element, Law};

/// Number of coordinates of a body.
const N: usize = COORDINATES.len();

/// Moving bodies and the linear forces on them.
#[derive(Debug, Clone)]
pub(super) struct Linear {
    /// Diagonal of `M`.
    pub inertia: DVector<f64>,
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub series: Vec<Series>,
}

/// A dashpot in series with a spring.
#[derive(Debug, Clone)]
pub(super) struct Series {
    /// Displacement of the pair per unit of each coordinate.
    pub displacement: RowDVector<f64>,
    pub damping: f64,
    pub stiffness: f64,
}

/// The attachment point of an element's end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attachment {
    /// Index of the moving body; `None` if the end is fixed.
    pub body: Option<usize>,
    /// Position from the body's centre, m.
    pub from_centre: Vector3<f64>,
    /// True if the end is on an axlebox, which does not follow the pitch of its body: the pitch of a wheelset is its
    /// spin.
    pub is_axlebox: bool,
}

impl Attachment {
    /// A point that turns with its body.
    pub fn new(body: Option<usize>, from_centre: Vector3<f64>) -> Self {
        let is_axlebox = false;
        Self {
            body,
            from_centre,
            is_axlebox,
        }
    }
}

/// Velocity amplitude at which the secant of a damper's characteristic gives its damping in small motion, m/s.
const SMALL_VELOCITY_M_PER_S: f64 = 1e-4;

/// Damping and series stiffness of a damper in small motion with its clearance taken up: the secant of its
/// characteristic and the stiffness of its mounts. The parameters must have been checked.
fn small_motion(parameters: &DamperParameters) -> [f64; 2] {
    let stiffness = 1.0 / parameters.mount.compliance_m_per_n();
    let Ok(checked) = parameters.check() else {
        return [0.0, stiffness];
    };
    let characteristic = Characteristic::new(&checked);
    let v = SMALL_VELOCITY_M_PER_S;
    let force = |velocity| characteristic.force_n(velocity);
    [(force(v) - force(-v)) / (2.0 * v), stiffness]
}

impl Linear {
    /// Returns the equations of bodies without elements.
    pub fn new(bodies: &[Body]) -> Self {
        let size = N * bodies.len();
        let inertia = bodies.iter().flat_map(Body::inertia);
        Self {
            inertia: DVector::from_iterator(size, inertia),
            stiffness: DMatrix::zeros(size, size),
            damping: DMatrix::zeros(size, size),
            series: Vec::new(),
        }
    }

    /// Returns the angular frequency of the fastest undamped oscillation, rad/s; zero without springs.
    pub fn fastest_rad_per_s(&self) -> f64 {
        let root = self.inertia.map(|inertia| 1.0 / inertia.sqrt());
        let scaled = self.stiffness.component_mul(&(&root * root.transpose()));
        scaled.symmetric_eigenvalues().max().max(0.0).sqrt()
    }

    /// Displacement of the second end relative to the first along x, y and z, per unit of each coordinate.
    pub fn displacement(&self, ends: &[Attachment; 2]) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3, self.inertia.len());
        for (end, sign) in ends.iter().zip([-1.0, 1.0]) {
            if let Some(body) = end.body {
                let mut block = rows.fixed_view_mut::<3, N>(0, N * body);
                block[(1, 0)] += sign;
                block[(2, 1)] += sign;
                // rotation x position = -(position x rotation).
                let mut rotations = block.fixed_columns_mut::<3>(2);
                rotations -= end.from_centre.cross_matrix() * sign;
                if end.is_axlebox {
                    block.column_mut(3).fill(0.0);
                }
                // A body is free along the track, so its pitch meets no resistance there.
                block[(0, 3)] = 0.0;
            }
        }
        rows
    }

    /// Rotation about x, y and z of the body at an end, per unit of each coordinate.
    fn rotation(&self, end: &Attachment) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3, self.inertia.len());
        if let Some(body) = end.body {
            rows.fixed_view_mut::<3, 3>(0, N * body + 2)
                .fill_with_identity();
            if end.is_axlebox {
                rows.column_mut(N * body + 3).fill(0.0);
            }
        }
        rows
    }

    /// Adds an element; `line` leads from its first end to its second.
    pub fn add(&mut self, element: &Element, ends: &[Attachment; 2], line: Vector3<f64>) {
        let displacement = self.displacement(ends);
        match &element.law {
            Law::SpringDamper {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => self.add_three(&displacement, stiffness_n_per_m, damping_n_s_per_m),
            Law::Bush {
                stiffness_n_per_m,
                damping_n_s_per_m,
                stiffness_n_m_per_rad,
                damping_n_m_s_per_rad,
            } => {
                self.add_three(&displacement, stiffness_n_per_m, damping_n_s_per_m);
                let rotation = self.rotation(&ends[1]) - self.rotation(&ends[0]);
                self.add_three(&rotation, stiffness_n_m_per_rad, damping_n_m_s_per_rad);
            }
            Law::Damper {
                direction,
                parameters,
            } => {
                let [damping, stiffness] = small_motion(parameters);
                self.series.push(Series {
                    displacement: displacement.row(direction.axis()).into_owned(),
                    damping,
                    stiffness,
                });
            }
            Law::BumpStop { .. } | Law::Friction { .. } => {}
            Law::AntiRollBar {
                stiffness_n_m_per_rad,
            } => {
                let mut roll = RowDVector::zeros(self.inertia.len());
                for (end, sign) in ends.iter().zip([-1.0, 1.0]) {
                    if let Some(body) = end.body {
                        roll[N * body + 2] += sign;
                    }
                }
                self.add_along(&roll, *stiffness_n_m_per_rad, 0.0);
            }
            Law::TractionRod {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                let along = line.normalize().transpose() * displacement;
                self.add_along(&along, *stiffness_n_per_m, *damping_n_s_per_m);
            }
        }
    }

    fn add_three(&mut self, rows: &DMatrix<f64>, stiffness: &[f64; 3], damping: &[f64; 3]) {
        for (row, (stiffness, damping)) in rows.row_iter().zip(stiffness.iter().zip(damping)) {
            self.add_along(&row.into_owned(), *stiffness, *damping);
        }
    }

    fn add_along(&mut self, displacement: &RowDVector<f64>, stiffness: f64, damping: f64) {
        self.stiffness += displacement.transpose() * displacement * stiffness;
        self.damping += displacement.transpose() * displacement * damping;
    }

    /// Adds the spring of a friction element whose slider sticks. It takes no part in the equilibrium, so it is added
    /// after it.
    pub fn add_sticking(&mut self, element: &Element, ends: &[Attachment; 2]) {
        if let Law::Friction {
            direction,
            stiffness_n_per_m,
            friction_n,
            load,
        } = &element.law
            && (*friction_n > 0.0 || load.as_ref().is_some_and(|load| load.coefficient > 0.0))
        {
            let displacement = self.displacement(ends).row(direction.axis()).into_owned();
            self.add_along(&displacement, *stiffness_n_per_m, 0.0);
        }
    }

    /// Adds the geometric stiffness of the static `force` on the second end.
    ///
    /// It is the second-order part of the potential `-F . R^T d`. The axes of the element turn by `R`, the mean
    /// rotation of both bodies; each end moves by `omega x (omega x r) / 2` beyond its first-order displacement.
    pub fn add_preload(&mut self, ends: &[Attachment; 2], force: Vector3<f64>) {
        for (end, sign) in ends.iter().zip([-0.5, 0.5]) {
            let rotation = self.rotation(end);
            let r = end.from_centre;
            let arm = force * r.transpose() + r * force.transpose()
                - Matrix3::identity() * (2.0 * force.dot(&r));
            self.stiffness -= rotation.transpose() * arm * &rotation * sign;
        }
        let mean = (self.rotation(&ends[0]) + self.rotation(&ends[1])) * 0.5;
        let turned = mean.transpose() * force.cross_matrix() * self.displacement(ends);
        self.stiffness -= turned.transpose();
        self.stiffness -= turned;
    }

    /// Matrix of the first-order equations. The states are the velocities, the displacements of the dashpots in series,
    /// and the coordinates that a force depends on; the spin angle of a wheelset is not one of them.
    pub fn first_order(&self) -> DMatrix<f64> {
        self.first_order_of(&self.used())
    }

    /// Returns the vehicle without the series dashpot `number`: matrix `A`, input `b` and output `c` of
    /// `x' = A x - b f`, `e = c x`, with its force `f` and its extension `e`. The coordinates stay those of the whole
    /// vehicle, so that the extension is known even if no other force depends on it.
    pub fn without(&self, number: usize) -> (DMatrix<f64>, DVector<f64>, DVector<f64>) {
        let (n, used) = (self.inertia.len(), self.used());
        let mut others = self.clone();
        let row = others.series.remove(number).displacement;
        let matrix = others.first_order_of(&used);
        let size = matrix.nrows();
        let input = |i: usize| if i < n { row[i] / self.inertia[i] } else { 0.0 };
        let output = |i: usize| {
            (i + used.len())
                .checked_sub(size)
                .map_or(0.0, |k| row[used[k]])
        };
        let [input, output] = [
            DVector::from_fn(size, |i, _| input(i)),
            DVector::from_fn(size, |i, _| output(i)),
        ];
        (matrix, input, output)
    }

    /// Coordinates that a force depends on.
    fn used(&self) -> Vec<usize> {
        (0..self.inertia.len())
            .filter(|i| self.is_used(*i))
            .collect()
    }

    fn first_order_of(&self, used: &[usize]) -> DMatrix<f64> {
        let n = self.inertia.len();
        let coordinates = n + self.series.len();
        let size = coordinates + used.len();
        let mut matrix = DMatrix::zeros(size, size);
        for i in 0..n {
            for j in 0..n {
                matrix[(i, j)] = -self.damping[(i, j)] / self.inertia[i];
            }
            for (number, j) in used.iter().enumerate() {
                matrix[(i, coordinates + number)] = -self.stiffness[(i, *j)] / self.inertia[i];
            }
        }
        for (number, series) in self.series.iter().enumerate() {
            // The force `k (x - e)` of the spring moves the dashpot: `c e' = k (x - e)`.
            let dashpot = n + number;
            let rate = series.stiffness / series.damping;
            for i in 0..n {
                let per_inertia = series.displacement[i] * series.stiffness / self.inertia[i];
                matrix[(i, dashpot)] += per_inertia;
                for (number, j) in used.iter().enumerate() {
                    matrix[(i, coordinates + number)] -= per_inertia * series.displacement[*j];
                }
            }
            for (number, j) in used.iter().enumerate() {
                matrix[(dashpot, coordinates + number)] += rate * series.displacement[*j];
            }
            matrix[(dashpot, dashpot)] -= rate;
        }
        for (number, j) in used.iter().enumerate() {
            matrix[(coordinates + number, *j)] = 1.0;
        }
        matrix
    }

    fn is_used(&self, coordinate: usize) -> bool {
        let by_springs = self.stiffness.column(coordinate).iter().any(|k| *k != 0.0);
        by_springs
            || self
                .series
                .iter()
                .any(|series| series.displacement[coordinate] != 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_moves_as_its_body_turns() {
        let linear = Linear::new(&[Body::new("body", 1.0, [1.0; 3], 1.0)]);
        let held = Attachment::new(None, Vector3::zeros());
        let end = Attachment::new(Some(0), Vector3::new(2.0, 3.0, 5.0));
        let rows = linear.displacement(&[held, end]);
        let (roll, pitch, yaw) = (1e-3, 2e-3, -3e-3);
        let moved = rows * DVector::from_vec(vec![0.1, 0.2, roll, pitch, yaw]);
        let expected = [
            -3.0 * yaw,
            0.1 - 5.0 * roll + 2.0 * yaw,
            0.2 + 3.0 * roll - 2.0 * pitch,
        ];
        for k in 0..3 {
            assert!((moved[k] - expected[k]).abs() < 1e-15);
        }
    }
}
