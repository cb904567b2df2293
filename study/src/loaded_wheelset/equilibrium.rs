//! The position and the rotation at which the rails carry a wheelset, with the creep forces.

use dashpot_rail::contact::{Motion, RailDisplacement, WheelDerivatives, WheelsetForces};

use super::LoadedWheelset;
use super::pressed::{Press, Pressed};

/// Maximum number of Newton steps.
const MAX_STEPS: usize = 25;
/// Maximum number of times that a step is halved.
const MAX_HALVINGS: usize = 6;
/// Columns of [`WheelDerivatives`]: the fields of [`Motion`] in their order.
const LATERAL: usize = 1;
const VERTICAL: usize = 2;
const ROLL: usize = 3;
const ROTATION: usize = 8;
/// Error of the forces relative to the load of a wheel.
const TOLERANCE: f64 = 1e-4;
/// Smallest change of the driving force by the relative change of the rotation, relative to the load: where both wheels
/// slide, the rotation hardly changes the force.
const MIN_SLOPE: f64 = 1e-3;

/// A wheelset that the rails carry.
pub(super) struct Equilibrium {
    pub motion: Motion,
    pub rails: [RailDisplacement; 2],
    pub forces: WheelsetForces,
}

impl LoadedWheelset {
    /// Finds the equilibrium at a lateral shift; `None` if there is none under the load.
    pub(super) fn equilibrium(&self, lateral_m: f64) -> Option<Equilibrium> {
        let pressed = Press::new(self).at(lateral_m, self.running.yaw_rad)?;
        self.equilibrium_from(lateral_m, &pressed)
    }

    /// Nominal height of the axle above the rails, m: the mean radius of the wheels.
    pub(super) fn radius_m(&self) -> f64 {
        let [left, right] = self.pairs().map(|pair| pair.installation().wheel_radius_m);
        0.5 * (left + right)
    }

    /// Newton's method for the equilibrium, from the wheelset without friction.
    fn equilibrium_from(&self, lateral_m: f64, pressed: &Pressed) -> Option<Equilibrium> {
        let mut state = State::new(self, lateral_m, pressed);
        let mut forces = state.forces(self);
        let mut residuals = state.residuals(self, &forces);
        for _ in 0..MAX_STEPS {
            if norm(&residuals) < TOLERANCE {
                return Some(Equilibrium {
                    motion: state.motion,
                    rails: state.rails,
                    forces,
                });
            }
            let step = solved(state.derivatives(self), residuals)?;
            let mut part = 1.0;
            for halving in 0..=MAX_HALVINGS {
                let next = state.moved(self, step.map(|change| -part * change));
                let next_forces = next.forces(self);
                let next_residuals = next.residuals(self, &next_forces);
                if norm(&next_residuals) < norm(&residuals) || halving == MAX_HALVINGS {
                    (state, forces, residuals) = (next, next_forces, next_residuals);
                    break;
                }
                part *= 0.5;
            }
        }
        None
    }
}

/// A wheelset on its way to the equilibrium.
#[derive(Clone)]
struct State {
    lateral_m: f64,
    motion: Motion,
    rails: [RailDisplacement; 2],
}

impl State {
    fn new(wheelset: &LoadedWheelset, lateral_m: f64, pressed: &Pressed) -> Self {
        let running = wheelset.running;
        let [left, right] = &pressed.wheels;
        let radius_m = wheelset.radius_m();
        let mean_radius_m =
            radius_m + 0.5 * (left.radius_beyond_datum_m() + right.radius_beyond_datum_m());
        // The datum of a wheel is lower than the centre of the wheelset by the cosine of its roll.
        let centre_m =
            0.5 * (left.depth_m + right.depth_m) + radius_m * (1.0 - libm::cos(pressed.roll_rad));
        let motion = Motion {
            speed_m_per_s: running.speed_m_per_s,
            vertical_m: centre_m,
            yaw_rad: running.yaw_rad,
            rotation_rad_per_s: running
                .rotation_rad_per_s
                .unwrap_or(running.speed_m_per_s / mean_radius_m),
            ..Motion::default()
        };
        let mut state = Self {
            lateral_m,
            motion,
            rails: [RailDisplacement::default(); 2],
        };
        state.set_roll(wheelset, pressed.roll_rad);
        if running.roll_rad.is_some() {
            // Each wheel has its own depth on a rail that is raised or lowered.
            let lever_m = wheelset.pairs()[1].installation().datum_offset_m()
                * libm::cos(running.yaw_rad)
                * libm::sin(pressed.roll_rad);
            let raised_m = 0.5 * (right.depth_m - left.depth_m) - lever_m;
            state.rails[0].vertical_m = raised_m;
            state.rails[1].vertical_m = -raised_m;
        }
        state
    }

    /// The shift holds at the top of the rails, not at the axle.
    fn set_roll(&mut self, wheelset: &LoadedWheelset, roll_rad: f64) {
        self.motion.roll_rad = roll_rad;
        self.motion.lateral_m = self.lateral_m + wheelset.radius_m() * libm::sin(roll_rad);
    }

    fn forces(&self, wheelset: &LoadedWheelset) -> WheelsetForces {
        wheelset.contact.forces(&self.motion, &self.rails)
    }

    /// Vertical forces that the wheels lack, and the force that drives the wheelset, relative to the load of a wheel.
    fn residuals(&self, wheelset: &LoadedWheelset, forces: &WheelsetForces) -> [f64; 3] {
        let load_n = wheelset.running.load_n;
        let [left, right] = &forces.wheels;
        let driving = if wheelset.running.rotation_rad_per_s.is_some() {
            0.0
        } else {
            dot(&forces.moment_n_m, &self.axle()) / (wheelset.radius_m() * load_n)
        };
        let lacking = |force_n: &[f64; 3]| -force_n[2] / load_n - 1.0;
        [lacking(&left.force_n), lacking(&right.force_n), driving]
    }

    /// Direction of the axle, to the right.
    fn axle(&self) -> [f64; 3] {
        let (roll, yaw) = (self.motion.roll_rad, self.motion.yaw_rad);
        [
            -libm::sin(yaw),
            libm::cos(yaw) * libm::cos(roll),
            libm::cos(yaw) * libm::sin(roll),
        ]
    }

    /// Derivatives of the residuals with respect to the depth of the wheelset, m, its roll, rad, and the relative
    /// change of its rotation; with a given roll, to the depths of both rails instead of the first two.
    fn derivatives(&self, wheelset: &LoadedWheelset) -> [[f64; 3]; 3] {
        let load_n = wheelset.running.load_n;
        let mut forces = WheelsetForces::default();
        let contact = &wheelset.contact;
        let sides = contact.update_with_derivatives(&self.motion, &self.rails, &mut forces);
        let arm_m = wheelset.radius_m() * libm::cos(self.motion.roll_rad);
        let axle = self.axle();
        let vertical = |side: &WheelDerivatives, column: usize| -side.force[2][column] / load_n;
        let driving = |side: &WheelDerivatives, column: usize| {
            dot(&[0, 1, 2].map(|k| side.moment[k][column]), &axle) / (wheelset.radius_m() * load_n)
        };
        let rolled = |of: &dyn Fn(usize) -> f64| of(ROLL) + arm_m * of(LATERAL);
        let rotation = self.motion.rotation_rad_per_s;
        let is_roll_given = wheelset.running.roll_rad.is_some();
        let row = |k: usize| {
            let side = &sides[k];
            let depth = vertical(side, VERTICAL);
            let roll = rolled(&|column| vertical(side, column));
            let turning = rotation * vertical(side, ROTATION);
            match (is_roll_given, k) {
                (false, _) => [depth, roll, turning],
                (true, 0) => [-depth, 0.0, turning],
                (true, _) => [0.0, -depth, turning],
            }
        };
        let both = |of: &dyn Fn(&WheelDerivatives) -> f64| of(&sides[0]) + of(&sides[1]);
        let last = if wheelset.running.rotation_rad_per_s.is_some() {
            [0.0, 0.0, 1.0]
        } else {
            let turning = rotation * both(&|side| driving(side, ROTATION));
            let [first, second] = if is_roll_given {
                [0, 1].map(|k| -driving(&sides[k], VERTICAL))
            } else {
                [
                    both(&|side| driving(side, VERTICAL)),
                    both(&|side| rolled(&|column| driving(side, column))),
                ]
            };
            // A faster rotation drives the wheelset forward.
            [first, second, turning.max(MIN_SLOPE)]
        };
        [row(0), row(1), last]
    }

    /// The state after changes of the unknowns of [`derivatives`](Self::derivatives).
    fn moved(&self, wheelset: &LoadedWheelset, [first, second, turning]: [f64; 3]) -> Self {
        let mut moved = self.clone();
        if wheelset.running.roll_rad.is_some() {
            moved.rails[0].vertical_m += first;
            moved.rails[1].vertical_m += second;
        } else {
            moved.motion.vertical_m += first;
            moved.set_roll(wheelset, self.motion.roll_rad + second);
        }
        moved.motion.rotation_rad_per_s *= 1.0 + turning.clamp(-0.01, 0.01);
        moved
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(residuals: &[f64; 3]) -> f64 {
    residuals
        .iter()
        .fold(0.0, |max, residual| residual.abs().max(max))
}

/// Solves `matrix x = right` by Cramer's rule; `None` if the matrix is singular.
fn solved(matrix: [[f64; 3]; 3], right: [f64; 3]) -> Option<[f64; 3]> {
    let determinant = |m: &[[f64; 3]; 3]| {
        let minor = |i: usize, j: usize| m[1][i] * m[2][j] - m[1][j] * m[2][i];
        m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
    };
    let whole = determinant(&matrix);
    let solution = [0, 1, 2].map(|column| {
        let mut replaced = matrix;
        for (row, value) in replaced.iter_mut().zip(right) {
            row[column] = value;
        }
        determinant(&replaced) / whole
    });
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}
