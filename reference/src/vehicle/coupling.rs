//! An element between two bodies: motion of its ends, its force, and the loads on both bodies.

use dashpot_rail::vehicle::{Direction, Element, Law, VehicleParameters};

use super::attachment::{Attachment, Coordinates, Pose, Vector, cross, dot};

/// Law of an element.
#[derive(Clone, Debug)]
pub(super) enum Action {
    /// Springs and dashpots along and about x, y and z.
    Springs {
        stiffness: Vector,
        damping: Vector,
        angular_stiffness: Vector,
        angular_damping: Vector,
    },
    /// Spring and dashpot along a unit vector.
    Rod {
        along: Vector,
        stiffness: f64,
        damping: f64,
    },
    /// Spring about x.
    Bar { stiffness: f64 },
    /// Force along an axis from the damper, stop or friction element with this index.
    Nonlinear { axis: usize, number: usize },
}

/// An element with its attachments.
#[derive(Clone, Debug)]
pub(super) struct Coupling {
    pub(super) attachments: [Attachment; 2],
    pub(super) action: Action,
    /// Force on the second end while the vehicle is at rest (N).
    pub(super) standing_force: Vector,
}

/// Motion of the second end relative to the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) shift: Vector,
    velocity: Vector,
    turn: Vector,
    turn_rate: Vector,
}

/// Displacement and velocity of a damper, stop or friction element.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Extension {
    pub(super) displacement: f64,
    pub(super) velocity: f64,
    /// Limit of the force of a friction element (N) and its rate (N/s).
    pub(super) limit: [f64; 2],
}

fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

impl Coupling {
    /// Builds an element without a standing force; `number` is the index of a damper, stop or friction element. `None`
    /// if its law is unknown.
    pub(super) fn new(
        vehicle: &VehicleParameters,
        element: &Element,
        number: usize,
    ) -> Option<Self> {
        let [first, second] = &element.ends;
        let action = match &element.law {
            Law::SpringDamper {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => Action::Springs {
                stiffness: *stiffness_n_per_m,
                damping: *damping_n_s_per_m,
                angular_stiffness: [0.0; 3],
                angular_damping: [0.0; 3],
            },
            Law::Bush {
                stiffness_n_per_m,
                damping_n_s_per_m,
                stiffness_n_m_per_rad,
                damping_n_m_s_per_rad,
            } => Action::Springs {
                stiffness: *stiffness_n_per_m,
                damping: *damping_n_s_per_m,
                angular_stiffness: *stiffness_n_m_per_rad,
                angular_damping: *damping_n_m_s_per_rad,
            },
            Law::Damper { direction, .. }
            | Law::BumpStop { direction, .. }
            | Law::Friction { direction, .. } => {
                let axis = match direction {
                    Direction::Longitudinal => 0,
                    Direction::Lateral => 1,
                    Direction::Vertical => 2,
                };
                Action::Nonlinear { axis, number }
            }
            Law::AntiRollBar {
                stiffness_n_m_per_rad,
            } => Action::Bar {
                stiffness: *stiffness_n_m_per_rad,
            },
            Law::TractionRod {
                stiffness_n_per_m,
                damping_n_s_per_m,
            } => {
                let line = minus(second.at_m, first.at_m);
                let length = dot(&line, &line).sqrt();
                Action::Rod {
                    // Heights are positive upwards, z is positive downwards.
                    along: [line[0] / length, line[1] / length, -line[2] / length],
                    stiffness: *stiffness_n_per_m,
                    damping: *damping_n_s_per_m,
                }
            }
            _ => return None,
        };
        Some(Self {
            attachments: [first, second].map(|end| Attachment::new(vehicle, end)),
            action,
            standing_force: [0.0; 3],
        })
    }

    pub(super) fn motion(&self, poses: &[Pose; 2]) -> Motion {
        let [first, second] = &self.attachments;
        let [from, to] = poses;
        Motion {
            shift: minus(
                second.shift(&to.displacement),
                first.shift(&from.displacement),
            ),
            velocity: minus(second.shift(&to.rate), first.shift(&from.rate)),
            turn: minus(
                second.turn(&to.displacement),
                first.turn(&from.displacement),
            ),
            turn_rate: minus(second.turn(&to.rate), first.turn(&from.rate)),
        }
    }

    /// Index of a damper, stop or friction element, and displacement and velocity along its axis.
    pub(super) fn along(&self, motion: &Motion) -> Option<(usize, f64, f64)> {
        match self.action {
            Action::Nonlinear { axis, number } => {
                Some((number, motion.shift[axis], motion.velocity[axis]))
            }
            _ => None,
        }
    }

    /// Force and moment of springs and dashpots on the second end.
    pub(super) fn spring_wrench(&self, motion: &Motion) -> [Vector; 2] {
        let resisting = |k: &Vector, x: &Vector, c: &Vector, v: &Vector| {
            std::array::from_fn(|i| -k[i] * x[i] - c[i] * v[i])
        };
        match &self.action {
            Action::Springs {
                stiffness,
                damping,
                angular_stiffness,
                angular_damping,
            } => [
                resisting(stiffness, &motion.shift, damping, &motion.velocity),
                resisting(
                    angular_stiffness,
                    &motion.turn,
                    angular_damping,
                    &motion.turn_rate,
                ),
            ],
            Action::Rod {
                along,
                stiffness,
                damping,
            } => {
                let force =
                    -stiffness * dot(along, &motion.shift) - damping * dot(along, &motion.velocity);
                [along.map(|component| component * force), [0.0; 3]]
            }
            Action::Bar { stiffness } => [[0.0; 3], [-stiffness * motion.turn[0], 0.0, 0.0]],
            Action::Nonlinear { .. } => [[0.0; 3]; 2],
        }
    }

    /// Vertical force of the springs on the second end and its rate, positive in its direction at rest. Only springs
    /// have one, and their dashpots do not count.
    pub(super) fn vertical_load(&self, motion: &Motion) -> [f64; 2] {
        let Action::Springs { stiffness, .. } = &self.action else {
            return [0.0; 2];
        };
        let [_, _, at_rest] = self.standing_force;
        let change = -stiffness[2] * at_rest.signum();
        [
            at_rest.abs() + change * motion.shift[2],
            change * motion.velocity[2],
        ]
    }

    /// Derivative of the vertical load with respect to the coordinates of both bodies.
    pub(super) fn vertical_load_slopes(&self) -> [Coordinates; 2] {
        let Action::Springs { stiffness, .. } = &self.action else {
            return [[0.0; 5]; 2];
        };
        // By virtual work, the loads from a unit force equal the displacements due to unit coordinates.
        let change = -stiffness[2] * self.standing_force[2].signum();
        self.loads(&[[0.0, 0.0, change], [0.0; 3]])
    }

    /// Loads on the first and second body from `force` and `moment` on the second end and their opposites on the first.
    pub(super) fn loads(&self, [force, moment]: &[Vector; 2]) -> [Coordinates; 2] {
        let opposite = |vector: &Vector| vector.map(|component| -component);
        [
            self.attachments[0].load(&opposite(force), &opposite(moment)),
            self.attachments[1].load(force, moment),
        ]
    }

    /// Loads on both bodies from a force of 1 N on the second end along the axis of a damper, stop or
    /// friction element.
    pub(super) fn loads_along(&self) -> [Coordinates; 2] {
        let mut force = [0.0; 3];
        if let Action::Nonlinear { axis, .. } = self.action {
            force[axis] = 1.0;
        }
        self.loads(&[force, [0.0; 3]])
    }

    /// Additional loads from the standing force as the bodies rotate.
    ///
    /// The potential is `U = -F . R^T (u2 - u1)`. In it, the ends are displaced by `u = u_c + omega x r + omega x
    /// (omega x r)/2`, and the axes rotate by the mean `m` of both rotations. To first order `-dU` consists of three
    /// terms:
    ///
    /// - the force `m x F` on the second end and its opposite on the first;
    /// - half of the moment `F x (u2 - u1)` on each body;
    /// - from `omega x (omega x r)/2`, the moment `(F (r . omega) + r (F . omega))/2 - (F . r) omega` on the second
    ///   body; on the first body the opposite of this moment with its own `r` and `omega`.
    pub(super) fn turned_loads(&self, poses: &[Pose; 2], motion: &Motion) -> [Coordinates; 2] {
        let f = &self.standing_force;
        let turns: [Vector; 2] =
            std::array::from_fn(|end| self.attachments[end].turn(&poses[end].displacement));
        let mean = std::array::from_fn(|i| 0.5 * (turns[0][i] + turns[1][i]));
        let force = cross(&mean, f);
        let couple = cross(f, &motion.shift);
        std::array::from_fn(|end| {
            let sign = if end == 0 { -1.0 } else { 1.0 };
            let (attachment, turn) = (&self.attachments[end], &turns[end]);
            let r = &attachment.arm;
            let (along_arm, along_force) = (0.5 * dot(r, turn), 0.5 * dot(f, turn));
            let moment: Vector = std::array::from_fn(|i| {
                let end_moment = f[i] * along_arm + r[i] * along_force - dot(f, r) * turn[i];
                0.5 * couple[i] + sign * end_moment
            });
            attachment.load(&force.map(|component| sign * component), &moment)
        })
    }
}
