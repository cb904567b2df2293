//! Equations of motion of each body under the loads of all elements, the rails and the track.

use dashpot_rail::contact::{
    Motion, PatchSource, RailDisplacement, WheelsetContact, WheelsetForces,
};
use dashpot_rail::creep::CreepLaw;

use super::attachment::{Coordinates, Pose};
use super::chain::Chain;
use super::coupling::{Coupling, Extension};
use super::frame::{Following, Path};
use super::friction::Friction;
use super::rails::Flexible;
use super::standing::Standing;
use super::stop::Stop;

/// Coordinates of a body.
pub(super) const N: usize = 5;

/// An element whose law has ranges: a damper, a stop or friction.
#[derive(Clone, Debug)]
pub(super) enum Ranged {
    /// Damper index, and the damper.
    Damper(usize, Box<Chain>),
    Stop(Stop),
    /// Number among the friction elements, and the element.
    Friction(usize, Friction),
}

/// A wheelset with its contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rolling {
    pub(super) standing: Standing,
    /// Angular momentum about the axle (kg m^2/s).
    pub(super) momentum: f64,
    /// Loads of the elements on the wheelset at rest, without the vertical load.
    pub(super) constant: Coordinates,
}

/// The vehicle. Its state consists of the coordinates of bodies and wheelsets, their velocities, the positions of the
/// dampers' pistons, and displacements and velocities of flexible rails.
pub(super) struct Equations<'a, L, S: PatchSource> {
    /// Contact of each wheelset.
    pub(super) contacts: Vec<&'a WheelsetContact<L, S>>,
    pub(super) inertia: Vec<Coordinates>,
    /// Wheelsets; their body indices follow those of the bodies.
    pub(super) wheelsets: Vec<Rolling>,
    pub(super) couplings: Vec<Coupling>,
    pub(super) ranged: Vec<Ranged>,
    pub(super) dampers: usize,
    /// `None` if the rails are rigid.
    pub(super) rails: Option<Flexible>,
}

/// Data that stays constant between two events.
#[derive(Clone, Debug)]
pub(super) struct Situation<'a> {
    pub(super) path: Path<'a>,
    /// Range of each damper, stop and friction element.
    pub(super) ranges: Vec<usize>,
    /// Position of the slider of each friction element that rests (m).
    pub(super) sliders: Vec<f64>,
    /// Motion of the track frames at the time of the last evaluation; iterations of a stage share it.
    following: (f64, Vec<Following>),
}

/// Rates and forces at a state.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    /// Rates of the coordinates.
    pub(super) rates: Vec<Coordinates>,
    pub(super) accelerations: Vec<Coordinates>,
    pub(super) piston_velocities: Vec<f64>,
    pub(super) contacts: Vec<WheelsetForces>,
    pub(super) damper_displacements: Vec<f64>,
    pub(super) damper_forces: Vec<f64>,
    pub(super) friction_forces: Vec<f64>,
}

impl<'a> Situation<'a> {
    pub(super) fn new(path: Path<'a>, ranges: Vec<usize>, sliders: Vec<f64>) -> Self {
        Self {
            path,
            ranges,
            sliders,
            following: (f64::NAN, Vec::new()),
        }
    }

    /// Selects the parts of the track around `time`.
    pub(super) fn enter(&mut self, time: f64) {
        self.path.enter(time);
        self.following.0 = f64::NAN;
    }

    pub(super) fn follow(&mut self, time: f64) {
        if self.following.0 != time {
            self.following = (time, self.path.following(time));
        }
    }

    pub(super) fn following(&self) -> &[Following] {
        &self.following.1
    }
}

impl<L: CreepLaw, S: PatchSource> Equations<'_, L, S> {
    pub(super) fn bodies(&self) -> usize {
        self.inertia.len()
    }

    pub(super) fn size(&self) -> usize {
        let rails = self.rails.map_or(0, |rails| rails.size());
        2 * N * self.bodies() + self.dampers + rails
    }

    fn coordinates(&self, state: &[f64], body: usize) -> Coordinates {
        std::array::from_fn(|k| state[N * body + k])
    }

    fn velocities(&self, state: &[f64], body: usize) -> Coordinates {
        self.coordinates(&state[N * self.bodies()..], body)
    }

    pub(super) fn pistons<'s>(&self, state: &'s [f64]) -> &'s [f64] {
        &state[2 * N * self.bodies()..][..self.dampers]
    }

    /// Poses of the bodies at the ends of an element: in the frame of the vehicle's middle, or in the body's own frame
    /// if one end is on the track.
    fn poses(&self, following: &[Following], state: &[f64], coupling: &Coupling) -> [Pose; 2] {
        let on_track = coupling
            .attachments
            .iter()
            .any(|attachment| attachment.body.is_none());
        std::array::from_fn(|end| {
            let Some(body) = coupling.attachments[end].body else {
                return Pose::default();
            };
            let (q, v) = (self.coordinates(state, body), self.velocities(state, body));
            let frame = &following[body];
            if on_track {
                Pose {
                    displacement: q,
                    rate: std::array::from_fn(|k| v[k] - frame.frame_velocity[k]),
                }
            } else {
                Pose {
                    displacement: std::array::from_fn(|k| q[k] + frame.offset[k]),
                    rate: std::array::from_fn(|k| v[k] + frame.offset_rate[k]),
                }
            }
        })
    }

    /// Load of an element (N) and its rate (N/s).
    fn load(&self, following: &[Following], state: &[f64], element: usize) -> [f64; 2] {
        let coupling = &self.couplings[element];
        coupling.vertical_load(&coupling.motion(&self.poses(following, state, coupling)))
    }

    /// Limit of the force of an element with ranges and its rate; zero if it is not a friction element.
    fn limit(&self, following: &[Following], state: &[f64], number: usize) -> [f64; 2] {
        let Ranged::Friction(_, friction) = &self.ranged[number] else {
            return [0.0; 2];
        };
        let load = friction.load.map_or([0.0; 2], |(element, _)| {
            self.load(following, state, element)
        });
        friction.limit(load)
    }

    /// Displacement and velocity of each damper, stop and friction element. The displacement of a damper is relative to
    /// the vehicle at rest, not to its piston.
    pub(super) fn extensions(&self, following: &[Following], state: &[f64]) -> Vec<Extension> {
        let mut extensions = vec![Extension::default(); self.ranged.len()];
        for coupling in &self.couplings {
            let motion = coupling.motion(&self.poses(following, state, coupling));
            if let Some((number, displacement, velocity)) = coupling.along(&motion) {
                extensions[number] = Extension {
                    displacement,
                    velocity,
                    limit: self.limit(following, state, number),
                };
            }
        }
        extensions
    }

    /// Returns the motion of a wheelset's contact, and the displacements of its rails.
    pub(super) fn contact_motion(
        &self,
        situation: &Situation<'_>,
        time: f64,
        state: &[f64],
        wheelset: usize,
    ) -> (Motion, [RailDisplacement; 2]) {
        let body = self.bodies() - self.wheelsets.len() + wheelset;
        let standing = &self.wheelsets[wheelset].standing;
        let (q, v) = (self.coordinates(state, body), self.velocities(state, body));
        let frame = &situation.following()[body].frame_velocity;
        let path = &situation.path;
        let motion = Motion {
            speed_m_per_s: path.speed,
            lateral_m: q[0],
            vertical_m: q[1] + standing.vertical,
            roll_rad: q[2],
            yaw_rad: q[4],
            lateral_velocity_m_per_s: v[0] - frame[0],
            vertical_velocity_m_per_s: v[1],
            roll_rate_rad_per_s: v[2] - frame[2],
            rotation_rad_per_s: standing.rotation - v[3],
            yaw_rate_rad_per_s: v[4],
        };
        let distance = path.distance_of(body, time);
        let mut rails = path.track.displacements(distance, path.speed);
        if let Some(flexible) = &self.rails {
            flexible.displace(state, wheelset, &mut rails);
        }
        (motion, rails)
    }

    /// Computes all rates and forces at a state.
    pub(super) fn outcome(
        &self,
        situation: &mut Situation<'_>,
        time: f64,
        state: &[f64],
        outcome: &mut Outcome,
    ) {
        situation.follow(time);
        let following = situation.following();
        let bodies = self.bodies();
        let mut loads = vec![[0.0; N]; bodies];
        let mut add = |coupling: &Coupling, on_ends: &[Coordinates; 2]| {
            for (attachment, load) in coupling.attachments.iter().zip(on_ends) {
                if let Some(body) = attachment.body {
                    for (sum, load) in loads[body].iter_mut().zip(load) {
                        *sum += load;
                    }
                }
            }
        };
        outcome.damper_displacements.resize(self.dampers, 0.0);
        outcome.damper_forces.resize(self.dampers, 0.0);
        outcome.piston_velocities.resize(self.dampers, 0.0);
        outcome.friction_forces.resize(situation.sliders.len(), 0.0);
        for coupling in &self.couplings {
            let poses = self.poses(following, state, coupling);
            let motion = coupling.motion(&poses);
            add(coupling, &coupling.loads(&coupling.spring_wrench(&motion)));
            add(coupling, &coupling.turned_loads(&poses, &motion));
            let Some((number, x, v)) = coupling.along(&motion) else {
                continue;
            };
            let range = situation.ranges[number];
            let resistance = match &self.ranged[number] {
                Ranged::Damper(number, chain) => {
                    let from_piston = x - self.pistons(state)[*number];
                    let force = chain.force(range, from_piston);
                    outcome.damper_displacements[*number] = x;
                    outcome.damper_forces[*number] = force;
                    outcome.piston_velocities[*number] =
                        chain.piston_velocity(range, from_piston, v);
                    force
                }
                Ranged::Stop(stop) => stop.force(range, x),
                Ranged::Friction(slider, friction) => {
                    let at = Extension {
                        displacement: x,
                        velocity: v,
                        limit: self.limit(following, state, number),
                    };
                    let force = friction.force(range, &at, situation.sliders[*slider]);
                    outcome.friction_forces[*slider] = force;
                    force
                }
            };
            let against = coupling
                .loads_along()
                .map(|load| load.map(|per| -per * resistance));
            add(coupling, &against);
        }
        self.add_contacts(situation, time, state, (&mut loads, outcome));
        let following = situation.following();
        outcome.rates.clear();
        outcome.accelerations.clear();
        for (body, load) in loads.iter().enumerate() {
            let frame = &following[body];
            let v = self.velocities(state, body);
            let mut rate: Coordinates = std::array::from_fn(|k| load[k] / self.inertia[body][k]);
            rate[0] += frame.acceleration[0];
            rate[1] += frame.acceleration[1];
            outcome.accelerations.push(rate);
            outcome
                .rates
                .push(std::array::from_fn(|k| v[k] - frame.frame_velocity[k]));
        }
    }

    /// Adds forces of the rails and gyroscopic moments.
    fn add_contacts(
        &self,
        situation: &Situation<'_>,
        time: f64,
        state: &[f64],
        (loads, outcome): (&mut [Coordinates], &mut Outcome),
    ) {
        outcome
            .contacts
            .resize_with(self.wheelsets.len(), WheelsetForces::default);
        let first = self.bodies() - self.wheelsets.len();
        for (number, rolling) in self.wheelsets.iter().enumerate() {
            let body = first + number;
            let (motion, rails) = self.contact_motion(situation, time, state, number);
            let contact = &mut outcome.contacts[number];
            self.contacts[number].update(&motion, &rails, contact);
            let roll = situation.following()[body].offset[2];
            let [_, y, z] = contact.force_n;
            let [about_x, about_y, about_z] = contact.moment_n_m;
            let v = self.velocities(state, body);
            let rail_loads = [
                y - roll * z,
                z + roll * y + rolling.standing.load,
                about_x - rolling.momentum * v[4],
                // Moment about the axle, which has yawed and rolled.
                about_y - motion.yaw_rad * about_x + motion.roll_rad * about_z,
                about_z + rolling.momentum * v[2],
            ];
            for (k, sum) in loads[body].iter_mut().enumerate() {
                *sum += rail_loads[k] + rolling.constant[k];
            }
        }
    }
}
