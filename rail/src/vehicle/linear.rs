//! Linear equations of motion: `M q'' + C q' + K q = f`, with a state of its own for every dashpot in series with a spring.

use dashpot_core::DamperParameters;
use dashpot_core::characteristic::Characteristic;
use nalgebra::{DMatrix, DVector, Matrix3, RowDVector, Vector3};

use super::body::{Body, COORDINATES};
use super::element::{Element, Law};

/// Coordinates of a body.
const N: usize = COORDINATES.len();

/// Bodies that move, and what acts on them.
#[derive(Debug, Clone)]
pub(super) struct Linear {
    /// Diagonal of `M`.
    pub inertia: DVector<f64>,
    pub stiffness: DMatrix<f64>,
    pub damping: DMatrix<f64>,
    pub series: Vec<Series>,
}

/// A dashpot in series with a spring, along a displacement that the coordinates make.
#[derive(Debug, Clone)]
pub(super) struct Series {
    pub displacement: RowDVector<f64>,
    pub damping: f64,
    pub stiffness: f64,
}

/// The end of an element: a body that moves, by its number, or what is held; the place from its centre, m; and whether it does
/// not follow the body's pitch, which is the spin of a wheelset in its axleboxes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub body: Option<usize>,
    pub from_centre: Vector3<f64>,
    pub is_axlebox: bool,
}

/// Velocity at which a damper's force is taken for its damping in small motion, m/s.
const SMALL_VELOCITY_M_PER_S: f64 = 1e-4;

/// Damping and stiffness in series of a damper in small motion, its clearance taken up: the secant of its characteristic, and
/// its mounts. Of parameters that were checked.
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
    /// Bodies without elements.
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

    /// Displacement along x, y and z of the second place against the first, for each coordinate.
    pub fn displacement(&self, places: &[Place; 2]) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3, self.inertia.len());
        for (place, sign) in places.iter().zip([-1.0, 1.0]) {
            if let Some(body) = place.body {
                let mut block = rows.fixed_view_mut::<3, N>(0, N * body);
                block[(1, 0)] += sign;
                block[(2, 1)] += sign;
                // The rotation vector times the place: minus the place times it.
                let mut rotations = block.fixed_columns_mut::<3>(2);
                rotations -= place.from_centre.cross_matrix() * sign;
                if place.is_axlebox {
                    block.column_mut(3).fill(0.0);
                }
                // Nothing holds a body along the track: it gives way to its pitch there.
                block[(0, 3)] = 0.0;
            }
        }
        rows
    }

    /// Rotation about x, y and z of the body of a place, for each coordinate.
    fn rotation(&self, place: &Place) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3, self.inertia.len());
        if let Some(body) = place.body {
            rows.fixed_view_mut::<3, 3>(0, N * body + 2)
                .fill_with_identity();
            if place.is_axlebox {
                rows.column_mut(N * body + 3).fill(0.0);
            }
        }
        rows
    }

    /// Adds an element between `places`, on `line` from one end to the other.
    pub fn add(&mut self, element: &Element, places: &[Place; 2], line: Vector3<f64>) {
        let displacement = self.displacement(places);
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
                let rotation = self.rotation(&places[1]) - self.rotation(&places[0]);
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
            Law::BumpStop { .. } => {}
            Law::AntiRollBar {
                stiffness_n_m_per_rad,
            } => {
                let mut roll = RowDVector::zeros(self.inertia.len());
                for (place, sign) in places.iter().zip([-1.0, 1.0]) {
                    if let Some(body) = place.body {
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

    /// Adds the geometric stiffness of the static `force` on the second of `places`: the second-order part of the potential
    /// `-F . R^T d`, where the axes of the element turn by the mean rotation `R` of both bodies, and its ends by
    /// `omega x (omega x r) / 2` beyond their first-order displacement.
    pub fn add_preload(&mut self, places: &[Place; 2], force: Vector3<f64>) {
        for (place, sign) in places.iter().zip([-0.5, 0.5]) {
            let rotation = self.rotation(place);
            let r = place.from_centre;
            let ends = force * r.transpose() + r * force.transpose()
                - Matrix3::identity() * (2.0 * force.dot(&r));
            self.stiffness -= rotation.transpose() * ends * &rotation * sign;
        }
        let mean = (self.rotation(&places[0]) + self.rotation(&places[1])) * 0.5;
        let turned = mean.transpose() * force.cross_matrix() * self.displacement(places);
        self.stiffness -= turned.transpose();
        self.stiffness -= turned;
    }

    /// Matrix of the first-order equations of the velocities, then of the displacements of the dashpots in series, then of those
    /// coordinates that something depends on: not of how far a wheelset has spun.
    pub fn first_order(&self) -> DMatrix<f64> {
        let n = self.inertia.len();
        let depended_on: Vec<usize> = (0..n).filter(|i| self.is_depended_on(*i)).collect();
        let coordinates = n + self.series.len();
        let size = coordinates + depended_on.len();
        let mut matrix = DMatrix::zeros(size, size);
        for i in 0..n {
            for j in 0..n {
                matrix[(i, j)] = -self.damping[(i, j)] / self.inertia[i];
            }
            for (number, j) in depended_on.iter().enumerate() {
                matrix[(i, coordinates + number)] = -self.stiffness[(i, *j)] / self.inertia[i];
            }
        }
        for (number, series) in self.series.iter().enumerate() {
            // Force `k (x - e)` of the spring, which moves the dashpot: `c e' = k (x - e)`.
            let dashpot = n + number;
            let rate = series.stiffness / series.damping;
            for i in 0..n {
                let per_inertia = series.displacement[i] * series.stiffness / self.inertia[i];
                matrix[(i, dashpot)] += per_inertia;
                for (number, j) in depended_on.iter().enumerate() {
                    matrix[(i, coordinates + number)] -= per_inertia * series.displacement[*j];
                }
            }
            for (number, j) in depended_on.iter().enumerate() {
                matrix[(dashpot, coordinates + number)] += rate * series.displacement[*j];
            }
            matrix[(dashpot, dashpot)] -= rate;
        }
        for (number, j) in depended_on.into_iter().enumerate() {
            matrix[(coordinates + number, j)] = 1.0;
        }
        matrix
    }

    fn is_depended_on(&self, coordinate: usize) -> bool {
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
        let body = Body {
            name: "body".into(),
            mass_kg: 1.0,
            inertia_kg_m2: [1.0; 3],
            x_m: 0.0,
            height_m: 1.0,
        };
        let linear = Linear::new(&[body]);
        let held = Place {
            body: None,
            from_centre: Vector3::zeros(),
            is_axlebox: false,
        };
        let place = Place {
            body: Some(0),
            from_centre: Vector3::new(2.0, 3.0, 5.0),
            is_axlebox: false,
        };
        let rows = linear.displacement(&[held, place]);
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
