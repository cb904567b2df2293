//! Jacobian matrix of the equations for the solver's iteration. The linear part is computed once, the rest at each
//! state.

use dashpot_rail::contact::{PatchSource, WheelDerivatives, WheelsetForces};
use dashpot_rail::creep::CreepLaw;

use super::attachment::{Coordinates, Pose};
use super::coupling::Coupling;
use super::equations::{Equations, N, Ranged, Situation};
use crate::linear::Matrix;

/// Index of the field of a contact's motion that corresponds to each coordinate of a wheelset.
const BY_COORDINATE: [Option<usize>; N] = [Some(1), Some(2), Some(3), None, Some(4)];
/// Index of the field of a contact's motion that corresponds to each velocity of a wheelset, and the sign.
const BY_VELOCITY: [(usize, f64); N] = [(5, 1.0), (6, 1.0), (7, 1.0), (8, -1.0), (9, 1.0)];

impl<L: CreepLaw, S: PatchSource> Equations<'_, L, S> {
    /// Constant part of the matrix: springs, dashpots, standing forces, gyroscopic moments, and rates of the
    /// coordinates.
    pub(super) fn linear_slopes(&self) -> Matrix {
        let coordinates = N * self.bodies();
        let mut matrix = Matrix::zeros(self.size());
        for k in 0..coordinates {
            matrix.add(k, coordinates + k, 1.0);
        }
        for coupling in &self.couplings {
            for (end, attachment) in coupling.attachments.iter().enumerate() {
                let Some(body) = attachment.body else {
                    continue;
                };
                for k in 0..N {
                    let mut unit = [0.0; N];
                    unit[k] = 1.0;
                    let column = N * body + k;
                    let displaced = Pose {
                        displacement: unit,
                        rate: [0.0; N],
                    };
                    let moving = Pose {
                        displacement: [0.0; N],
                        rate: unit,
                    };
                    for (pose, column) in [(displaced, column), (moving, coordinates + column)] {
                        let mut poses = [Pose::default(); 2];
                        poses[end] = pose;
                        let motion = coupling.motion(&poses);
                        let springs = coupling.loads(&coupling.spring_wrench(&motion));
                        self.add_column(&mut matrix, coupling, &springs, column);
                        let turned = coupling.turned_loads(&poses, &motion);
                        self.add_column(&mut matrix, coupling, &turned, column);
                    }
                }
            }
        }
        let first = self.bodies() - self.wheelsets.len();
        for (number, rolling) in self.wheelsets.iter().enumerate() {
            let body = first + number;
            let (roll, yaw) = (coordinates + N * body + 2, coordinates + N * body + 4);
            matrix.add(roll, yaw, -rolling.momentum / self.inertia[body][2]);
            matrix.add(yaw, roll, rolling.momentum / self.inertia[body][4]);
        }
        matrix
    }

    fn add_column(
        &self,
        matrix: &mut Matrix,
        coupling: &Coupling,
        loads: &[Coordinates; 2],
        column: usize,
    ) {
        for (attachment, load) in coupling.attachments.iter().zip(loads) {
            if let Some(body) = attachment.body {
                for (k, load) in load.iter().enumerate() {
                    let row = N * (self.bodies() + body) + k;
                    matrix.add(row, column, load / self.inertia[body][k]);
                }
            }
        }
    }

    /// Adds the effect of an element's load on the force of a friction element, `by_load` per load. Only the iteration
    /// uses it, so it may be wrong where the spring has no load.
    fn add_load(&self, matrix: &mut Matrix, friction: &Coupling, by_load: f64, element: usize) {
        let spring = &self.couplings[element];
        let slopes = spring.vertical_load_slopes();
        for (attachment, slopes) in spring.attachments.iter().zip(slopes) {
            let Some(body) = attachment.body else {
                continue;
            };
            for (k, slope) in slopes.into_iter().enumerate() {
                let per_newton = friction.loads_along();
                let loads = per_newton.map(|load| load.map(|per| -per * by_load * slope));
                self.add_column(matrix, friction, &loads, N * body + k);
            }
        }
    }

    /// Complete matrix at a state.
    pub(super) fn slopes(
        &self,
        linear: &Matrix,
        situation: &mut Situation<'_>,
        time: f64,
        state: &[f64],
    ) -> Matrix {
        let mut matrix = linear.clone();
        situation.follow(time);
        let coordinates = N * self.bodies();
        let extensions = self.extensions(situation.following(), state);
        for coupling in &self.couplings {
            let at_rest = coupling.motion(&[Pose::default(); 2]);
            let Some((number, ..)) = coupling.along(&at_rest) else {
                continue;
            };
            let per_newton = coupling.loads_along();
            let range = situation.ranges[number];
            let displacement = extensions[number].displacement;
            // By virtual work, the loads from a unit force equal the displacements due to unit coordinates.
            let (slope, damper) = match &self.ranged[number] {
                Ranged::Stop(stop) => (stop.slope(range), None),
                Ranged::Friction(_, friction) => {
                    let [slope, by_load] = friction.slopes(range);
                    if let Some((element, _)) = friction.load {
                        self.add_load(&mut matrix, coupling, by_load, element);
                    }
                    (slope, None)
                }
                Ranged::Damper(damper, chain) => {
                    let piston = 2 * coordinates + damper;
                    let from_piston = displacement - state[piston];
                    let [slope, piston_slope, yields] = chain.slopes(range, from_piston);
                    matrix.add(piston, piston, -piston_slope);
                    (slope, Some((piston, piston_slope, yields)))
                }
            };
            let resisting = per_newton.map(|load| load.map(|per| -per * slope));
            for (end, attachment) in coupling.attachments.iter().enumerate() {
                let Some(body) = attachment.body else {
                    continue;
                };
                for (k, moved) in per_newton[end].iter().enumerate() {
                    let column = N * body + k;
                    let loads = resisting.map(|load| load.map(|load| load * moved));
                    self.add_column(&mut matrix, coupling, &loads, column);
                    if let Some((piston, piston_slope, yields)) = damper {
                        matrix.add(piston, column, piston_slope * moved);
                        matrix.add(piston, coordinates + column, yields * moved);
                    }
                }
            }
            if let Some((piston, ..)) = damper {
                let loads = resisting.map(|load| load.map(|load| -load));
                self.add_column(&mut matrix, coupling, &loads, piston);
            }
        }
        self.add_contact_slopes(&mut matrix, situation, time, state);
        matrix
    }

    fn add_contact_slopes(
        &self,
        matrix: &mut Matrix,
        situation: &Situation<'_>,
        time: f64,
        state: &[f64],
    ) {
        let coordinates = N * self.bodies();
        let mut forces = WheelsetForces::default();
        for number in 0..self.wheelsets.len() {
            let body = self.bodies() - self.wheelsets.len() + number;
            let (motion, rails) = self.contact_motion(situation, time, state, number);
            let wheels =
                self.contacts[number].update_with_derivatives(&motion, &rails, &mut forces);
            // Rates that a wheel's forces cause, by the wheelset's coordinate and a field of its motion.
            let slope = |wheel: &WheelDerivatives, k: usize, field: usize| {
                let load = match k {
                    0 | 1 => wheel.force[k + 1][field],
                    // Moment about the axle, which has yawed and rolled.
                    3 => {
                        wheel.moment[1][field] - motion.yaw_rad * wheel.moment[0][field]
                            + motion.roll_rad * wheel.moment[2][field]
                    }
                    _ => wheel.moment[k - 2][field],
                };
                load / self.inertia[body][k]
            };
            for k in 0..N {
                let by = |field: usize| -> f64 {
                    wheels.iter().map(|wheel| slope(wheel, k, field)).sum()
                };
                let row = coordinates + N * body + k;
                for column in 0..N {
                    let coordinate = N * body + column;
                    if let Some(field) = BY_COORDINATE[column] {
                        matrix.add(row, coordinate, by(field));
                    }
                    let (field, sign) = BY_VELOCITY[column];
                    matrix.add(row, coordinates + coordinate, sign * by(field));
                }
                if k == 3 {
                    let [about_x, _, about_z] = forces.moment_n_m;
                    let spin = self.inertia[body][k];
                    matrix.add(row, N * body + 2, about_z / spin);
                    matrix.add(row, N * body + 4, -about_x / spin);
                }
            }
            let Some(flexible) = &self.rails else {
                continue;
            };
            for (side, wheel) in wheels.iter().enumerate() {
                for direction in 0..2 {
                    // A rail that moves acts on its wheel as if the wheel moved the other way.
                    let columns = flexible.places(number, side, direction);
                    let fields = [BY_COORDINATE[direction], Some(BY_VELOCITY[direction].0)];
                    for (column, field) in columns.into_iter().zip(fields) {
                        let Some(field) = field else { continue };
                        for k in 0..N {
                            let row = coordinates + N * body + k;
                            matrix.add(row, column, -slope(wheel, k, field));
                        }
                        for along in 0..2 {
                            let [_, row] = flexible.places(number, side, along);
                            let [mass, ..] = flexible.mass_on_spring(along);
                            matrix.add(row, column, wheel.force[1 + along][field] / mass);
                        }
                    }
                    let [at, row] = columns;
                    let [mass, stiffness, damping] = flexible.mass_on_spring(direction);
                    matrix.add(at, row, 1.0);
                    matrix.add(row, at, -stiffness / mass);
                    matrix.add(row, row, -damping / mass);
                    for column in 0..N {
                        let coordinate = N * body + column;
                        let by = |field: usize| -wheel.force[1 + direction][field] / mass;
                        if let Some(field) = BY_COORDINATE[column] {
                            matrix.add(row, coordinate, by(field));
                        }
                        let (field, sign) = BY_VELOCITY[column];
                        matrix.add(row, coordinates + coordinate, sign * by(field));
                    }
                }
            }
        }
    }
}
