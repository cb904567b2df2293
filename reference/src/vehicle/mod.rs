//! Reference solution of a vehicle that runs along a track.
//!
//! The Newton-Euler equations of each body are integrated by an adaptive stiff solver to a stated tolerance. The forces
//! of elements follow from the motion of their ends; dampers use the laws of the [reference damper](crate::damper) with
//! clearance, held piston, flow and yielding; friction elements rest or slide. The solver restarts where a damper, stop
//! or friction element passes an edge of its law, and where a body passes an edge of the track. Only the wheel-rail
//! contact, [`dashpot_rail::contact`], and the description of the vehicle are shared with the real-time model.
//!
//! Coordinates of each body are lateral, vertical (m), roll, pitch and yaw (rad), relative to the vehicle at rest, in
//! the frame that follows the track at the body. Velocities are absolute, in the same axes. The pitch of a wheelset is
//! its rotation relative to free rolling.

mod attachment;
mod chain;
mod coupling;
mod equations;
mod events;
mod frame;
mod friction;
mod rails;
mod ranges;
mod slopes;
mod solver;
mod standing;
mod stop;
mod tabulated;

use dashpot_rail::contact::{PatchSource, WheelsetContact, WheelsetForces};
use dashpot_rail::creep::CreepLaw;
use dashpot_rail::track::Track;
use dashpot_rail::vehicle::{
    GRAVITY_M_PER_S2, Law, RailSupport, Standstill, VehicleError, VehicleParameters,
};

use self::chain::{CLEARANCE, Chain};
use self::coupling::Coupling;
use self::equations::{Equations, N, Outcome, Ranged, Rolling, Situation};
use self::frame::{Path, Runner};
use self::friction::{Friction, RESTING};
use self::rails::Flexible;
use self::standing::Standing;
use self::stop::Stop;
use crate::error::ReferenceError;

/// Bounds of the speed (m/s).
const SPEED_M_PER_S: [f64; 2] = [0.1, 200.0];
/// Bounds of the tolerance.
const TOLERANCE: [f64; 2] = [1e-12, 1e-2];

/// Reference solver of a vehicle.
pub struct VehicleReference<'a, L, S: PatchSource> {
    equations: Equations<'a, L, S>,
    situation: Situation<'a>,
    start: Vec<f64>,
    statistics: Statistics,
}

/// Motion and forces of a vehicle at one time; wheelsets follow the bodies.
#[derive(Clone, Debug, Default)]
pub struct VehicleSample {
    /// Time since the start (s).
    pub time_s: f64,
    /// Lateral, vertical (m), roll, pitch and yaw (rad) relative to the track at the body.
    pub coordinates: Vec<[f64; 5]>,
    /// Absolute velocities (m/s, rad/s).
    pub velocities: Vec<[f64; 5]>,
    /// Rates of the velocities (m/s^2, rad/s^2).
    pub accelerations: Vec<[f64; 5]>,
    /// Forces of the rails on each wheelset.
    pub contacts: Vec<WheelsetForces>,
    /// Displacement of each damper in the order of the elements, positive in extension (m).
    pub damper_displacements_m: Vec<f64>,
    /// Force of each damper, positive if it resists extension (N).
    pub damper_forces_n: Vec<f64>,
    /// Force of each friction element in the order of the elements, positive if it resists a positive displacement of
    /// its second end (N).
    pub friction_forces_n: Vec<f64>,
}

/// Statistics of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps of the solver.
    pub steps: usize,
    /// Steps rejected because of their error.
    pub rejected: usize,
    /// Evaluations of the equations.
    pub evaluations: usize,
    /// Factorisations of the iteration matrix of Newton's method.
    pub factorisations: usize,
    /// Changes of the range of a damper, stop or friction element.
    pub events: usize,
}

impl<'a, L: CreepLaw, S: PatchSource> VehicleReference<'a, L, S> {
    /// Builds a freely rolling vehicle in its rest position, with its middle at the distance `start_m` along `track`.
    ///
    /// # Errors
    /// The vehicle has no equilibrium, the speed is not within 0.1 to 200 m/s, the rails do not carry a wheelset, or
    /// the law of a damper has no solution.
    pub fn new(
        vehicle: &VehicleParameters,
        contact: &'a WheelsetContact<L, S>,
        track: &'a Track,
        speed_m_per_s: f64,
        start_m: f64,
    ) -> Result<Self, ReferenceError> {
        let contacts = vec![contact; vehicle.wheelsets.len()];
        Self::with_contacts(vehicle, contacts, track, speed_m_per_s, start_m)
    }

    /// Builds the vehicle like [`VehicleReference::new`], with a contact for each wheelset.
    ///
    /// # Errors
    /// Those of [`VehicleReference::new`], or a number of contacts other than that of the wheelsets.
    pub fn with_contacts(
        vehicle: &VehicleParameters,
        contacts: Vec<&'a WheelsetContact<L, S>>,
        track: &'a Track,
        speed_m_per_s: f64,
        start_m: f64,
    ) -> Result<Self, ReferenceError> {
        if contacts.len() != vehicle.wheelsets.len() {
            return Err(VehicleError::Contacts {
                contacts: contacts.len(),
                wheelsets: vehicle.wheelsets.len(),
            }
            .into());
        }
        // This only checks names and values; the solution is not used.
        Standstill::new(vehicle)?;
        VehicleError::check(&vehicle.name, "speed_m_per_s", speed_m_per_s, SPEED_M_PER_S)?;
        VehicleError::check(&vehicle.name, "start_m", start_m, [-1e7, 1e7])?;
        let (mut couplings, mut ranged, mut dampers, mut sliders) = (Vec::new(), Vec::new(), 0, 0);
        for element in &vehicle.elements {
            let coupling = Coupling::new(vehicle, element, ranged.len());
            couplings.push(coupling.ok_or_else(|| ReferenceError::UnknownLaw {
                element: element.name.clone(),
            })?);
            match &element.law {
                Law::Damper { parameters, .. } => {
                    ranged.push(Ranged::Damper(dampers, Box::new(Chain::new(parameters)?)));
                    dampers += 1;
                }
                Law::BumpStop { points, .. } => ranged.push(Ranged::Stop(Stop::new(points))),
                Law::Friction {
                    stiffness_n_per_m,
                    friction_n,
                    load,
                    ..
                } => {
                    let mut elements = vehicle.elements.iter();
                    let friction = Friction {
                        stiffness: *stiffness_n_per_m,
                        constant: *friction_n,
                        load: load.as_ref().and_then(|load| {
                            let spring = elements.position(|spring| spring.name == load.spring);
                            spring.map(|spring| (spring, load.coefficient))
                        }),
                    };
                    ranged.push(Ranged::Friction(sliders, friction));
                    sliders += 1;
                }
                _ => {}
            }
        }
        let on_wheelsets = standing::load_elements(vehicle, &mut couplings)?;
        let mut inertia = Vec::new();
        let mut runners = Vec::new();
        for body in &vehicle.bodies {
            inertia.push(with_mass(body.mass_kg, body.inertia_kg_m2));
            runners.push(Runner {
                x: body.x_m,
                height: body.height_m,
            });
        }
        let mut wheelsets = Vec::new();
        let with_contacts = vehicle.wheelsets.iter().zip(&contacts);
        for ((wheelset, contact), mut constant) in with_contacts.zip(on_wheelsets) {
            inertia.push(with_mass(wheelset.mass_kg, wheelset.inertia_kg_m2));
            runners.push(Runner {
                x: wheelset.x_m,
                height: wheelset.radius_m,
            });
            let load = wheelset.mass_kg * GRAVITY_M_PER_S2 + std::mem::take(&mut constant[1]);
            let standing = Standing::new(contact, speed_m_per_s, load).ok_or_else(|| {
                VehicleError::NotCarried {
                    wheelset: wheelset.name.clone(),
                    load_n: load,
                }
            })?;
            wheelsets.push(Rolling {
                standing,
                momentum: wheelset.inertia_kg_m2[1] * standing.rotation,
                constant,
            });
        }
        let ranges = ranged.iter().map(|element| match element {
            Ranged::Damper(..) => CLEARANCE,
            Ranged::Stop(stop) => stop.ranges.edges.len() / 2,
            Ranged::Friction(..) => RESTING,
        });
        let path = Path::new(track, speed_m_per_s, start_m, &runners);
        let mut situation = Situation::new(path, ranges.collect(), vec![0.0; sliders]);
        let equations = Equations {
            contacts,
            inertia,
            wheelsets,
            couplings,
            ranged,
            dampers,
            rails: None,
        };
        situation.follow(0.0);
        let coordinates = N * equations.bodies();
        let mut start = vec![0.0; equations.size()];
        for (k, frame) in situation.following().iter().enumerate() {
            start[coordinates + N * k..][..N].copy_from_slice(&frame.frame_velocity);
        }
        let extensions = equations.extensions(situation.following(), &start);
        for (element, at) in equations.ranged.iter().zip(extensions) {
            match element {
                Ranged::Damper(damper, _) => start[2 * coordinates + damper] = at.displacement,
                Ranged::Friction(slider, _) => situation.sliders[*slider] = at.displacement,
                Ranged::Stop(_) => {}
            }
        }
        Ok(Self {
            equations,
            situation,
            start,
            statistics: Statistics::default(),
        })
    }

    /// Puts the vehicle on flexible rails, which start at rest under it.
    ///
    /// # Errors
    /// Those of [`RailSupport::check`].
    pub fn on_flexible_rails(mut self, support: RailSupport) -> Result<Self, ReferenceError> {
        support.check()?;
        let first = 2 * N * self.equations.bodies() + self.equations.dampers;
        let wheelsets = self.equations.wheelsets.len();
        self.equations.rails = Some(Flexible::new(support, wheelsets, first));
        self.start.resize(self.equations.size(), 0.0);
        Ok(self)
    }

    /// Runs the vehicle from time 0 and returns a sample at each of the increasing times (s). `tolerance` is relative
    /// and holds per step.
    ///
    /// # Errors
    /// Times that are negative or do not increase, or a tolerance that is not within 1e-12 to 0.01 or cannot be
    /// reached.
    pub fn run(
        &mut self,
        times_s: &[f64],
        tolerance: f64,
    ) -> Result<Vec<VehicleSample>, ReferenceError> {
        let mut samples = Vec::with_capacity(times_s.len());
        self.run_each(times_s, tolerance, |sample| samples.push(sample.clone()))?;
        Ok(samples)
    }

    /// Runs the vehicle like [`VehicleReference::run`], and passes each sample on instead of collecting them.
    ///
    /// # Errors
    /// Those of [`VehicleReference::run`].
    pub fn run_each(
        &mut self,
        times_s: &[f64],
        tolerance: f64,
        mut on_sample: impl FnMut(&VehicleSample),
    ) -> Result<(), ReferenceError> {
        VehicleError::check("reference", "tolerance", tolerance, TOLERANCE)?;
        for (sample, time_s) in times_s.iter().enumerate() {
            VehicleError::check("reference", "time_s", *time_s, [0.0, 1e6])?;
            let before_s = sample.checked_sub(1).map_or(-1.0, |before| times_s[before]);
            if *time_s <= before_s {
                return Err(ReferenceError::Times {
                    sample,
                    time_s: *time_s,
                    before_s,
                });
            }
        }
        let equations = &self.equations;
        let on_sample = |situation: &mut Situation<'a>, time: f64, state: &[f64]| {
            on_sample(&sample(equations, situation, time, state));
        };
        self.statistics = solver::run(
            equations,
            self.situation.clone(),
            &self.start,
            times_s,
            tolerance,
            on_sample,
        )?;
        Ok(())
    }

    /// Statistics of the last run.
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }
}

fn sample<'a, L: CreepLaw, S: PatchSource>(
    equations: &Equations<'a, L, S>,
    situation: &mut Situation<'a>,
    time: f64,
    state: &[f64],
) -> VehicleSample {
    let mut outcome = Outcome::default();
    equations.outcome(situation, time, state, &mut outcome);
    let coordinates = N * equations.bodies();
    let fives = |numbers: &[f64]| {
        let five = |five: &[f64]| std::array::from_fn(|k| five[k]);
        numbers.chunks_exact(N).map(five).collect()
    };
    VehicleSample {
        time_s: time,
        coordinates: fives(&state[..coordinates]),
        velocities: fives(&state[coordinates..2 * coordinates]),
        accelerations: outcome.accelerations,
        contacts: outcome.contacts,
        damper_displacements_m: outcome.damper_displacements,
        damper_forces_n: outcome.damper_forces,
        friction_forces_n: outcome.friction_forces,
    }
}

fn with_mass(mass: f64, [roll, pitch, yaw]: [f64; 3]) -> [f64; N] {
    [mass, mass, roll, pitch, yaw]
}
