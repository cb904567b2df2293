//! The vehicle in real time: constants, state, and a step of constant cost.

mod across;
mod block;
mod dampers;
mod energy;
mod guidance;
mod method;
mod rails;
mod springs;
mod state;
mod step;
mod structure;
mod tangent;

use std::sync::Arc;

use dashpot_core::{Damper, DamperParameters};
use fearless_simd::{Level, dispatch};
use nalgebra::DMatrix;

use self::across::{Across, DamperElement, StopElement};
use self::block::{N, Vector};
pub use self::energy::Energy;
pub use self::guidance::CANT_BASE_M;
use self::guidance::{Guidance, Stand};
use self::method::Method;
pub use self::rails::RailSupport;
use self::springs::Springs;
pub use self::state::VehicleState;
use self::state::Work;
use self::structure::{Blocks, Structure};
use self::tangent::{ContactPlace, SurfaceConstants};
use super::body::VehicleParameters;
use super::carried::Carried;
use super::element::Law;
use super::error::VehicleError;
use super::linear::Linear;
use super::standstill::{Standstill, places, wheelset_bodies};
use crate::contact::{PatchSource, Tables, WheelsetContact, WheelsetForces};
use crate::creep::CreepLaw;
use crate::track::Track;

/// Bounds of the step size of a [`Vehicle`], s.
pub const STEP_S: [f64; 2] = [0.02e-3, 2e-3];

/// Bounds of the speed of a [`Vehicle`], m/s.
pub const SPEED_M_PER_S: [f64; 2] = [1.0, 150.0];

/// A vehicle in real time: constants for one step size, shared by any number of states.
#[derive(Debug, Clone)]
pub struct Vehicle<L, S: PatchSource = Tables> {
    step_s: f64,
    method: Method,
    contact: Arc<WheelsetContact<L, S>>,
    surface: SurfaceConstants,
    level: Level,
    names: Vec<String>,
    stands: Vec<Stand>,
    wheelsets: Vec<WheelsetConstants>,
    inertia: Vec<Vector>,
    springs: Springs,
    structure: Structure,
    /// `M + weighted damping and stiffness`: what a step solves without the contact.
    system: Blocks,
    /// Those of the springs that hold a body on the track; none where no element does.
    on_track: Option<Springs>,
    dampers: Vec<DamperElement>,
    stops: Vec<StopElement>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct WheelsetConstants {
    place: ContactPlace,
    /// Forces on rails that give way, N.
    standing_n: Vector,
    carried: Carried,
    axle_load_n: f64,
    spin_inertia_kg_m2: f64,
}

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// The vehicle of `parameters`, all of its wheelsets with `contact`, for a step of `step_s`.
    ///
    /// # Errors
    /// As [`Standstill::new`]; a step out of bounds or too long for the stiffness of the elements; a wheelset that the rails do not
    /// carry; no wheelset.
    pub fn new(
        parameters: &VehicleParameters,
        contact: Arc<WheelsetContact<L, S>>,
        step_s: f64,
    ) -> Result<Self, VehicleError> {
        Self::on_rails(parameters, contact, step_s, None)
    }

    /// The vehicle on rails that give way under each wheel, where a support is given.
    ///
    /// # Errors
    /// As [`Vehicle::new`]; a support that is refused.
    pub fn on_rails(
        parameters: &VehicleParameters,
        contact: Arc<WheelsetContact<L, S>>,
        step_s: f64,
        support: Option<RailSupport>,
    ) -> Result<Self, VehicleError> {
        VehicleError::check(&parameters.name, "step_s", step_s, STEP_S)?;
        let standstill = Standstill::new(parameters)?;
        if parameters.wheelsets.is_empty() {
            return Err(VehicleError::NoWheelset);
        }
        let mut bodies = parameters.bodies.clone();
        bodies.extend(wheelset_bodies(parameters));
        let mut linear = Linear::new(&bodies);
        let mut on_track = Linear::new(&bodies);
        let (mut dampers, mut stops) = (Vec::new(), Vec::new());
        let ends = places(parameters, true)?;
        for ((element, (places, line)), force) in parameters
            .elements
            .iter()
            .zip(&ends)
            .zip(standstill.forces())
        {
            match &element.law {
                Law::Damper {
                    direction,
                    parameters,
                } => dampers.push(DamperElement {
                    name: element.name.clone(),
                    across: Across::new(&linear, places, direction.axis()),
                    damper: build(&element.name, parameters, step_s)?,
                }),
                Law::BumpStop { direction, points } => stops.push(StopElement {
                    across: Across::new(&linear, places, direction.axis()),
                    points: points.clone(),
                }),
                _ => {
                    linear.add(element, places, *line);
                    linear.add_preload(places, *force);
                    if places.iter().any(|place| place.body.is_none()) {
                        on_track.add(element, places, *line);
                        on_track.add_preload(places, *force);
                    }
                }
            }
        }
        let (first, count) = (parameters.bodies.len(), parameters.wheelsets.len());
        let Linear {
            mut inertia,
            mut stiffness,
            mut damping,
            ..
        } = linear;
        if let Some(support) = support {
            support.check()?;
            support.append(count, &mut inertia, &mut stiffness, &mut damping);
        }
        let method = Method::new(step_s);
        let system = DMatrix::from_diagonal(&inertia)
            + &damping * method.damping_weight()
            + &stiffness * method.stiffness_weight();
        let mut pattern = system.clone();
        let rails_of = |number: usize| support.is_some().then_some(first + count + number);
        for number in 0..count {
            if let Some(rails) = rails_of(number) {
                pattern[(N * rails, N * (first + number))] = 1.0;
            }
        }
        let structure = Structure::new(&pattern);
        let system = structure.blocks(&system);
        let level = Level::new();
        if !dispatch!(level, simd => structure.factorise(simd, &mut system.clone())) {
            return Err(VehicleError::StepTooLong { step_s });
        }
        let mut wheelsets = Vec::with_capacity(count);
        for (number, wheelset) in parameters.wheelsets.iter().enumerate() {
            let load_n = standstill.axle_loads_n()[number];
            let carried =
                Carried::new(&contact, load_n).ok_or_else(|| VehicleError::NotCarried {
                    wheelset: wheelset.name.clone(),
                    load_n,
                })?;
            let body = first + number;
            // Rails hang on their wheelset alone, so that they go before it.
            let rails = rails_of(number);
            let coupled = rails.and_then(|rails| Some((rails, structure.coupling(rails, body)?)));
            wheelsets.push(WheelsetConstants {
                place: ContactPlace {
                    wheelset: body,
                    rails: coupled,
                },
                standing_n: rails::standing_n(&carried.wheel_forces_n),
                carried,
                axle_load_n: load_n,
                spin_inertia_kg_m2: wheelset.inertia_kg_m2[1],
            });
        }
        let is_held = on_track.stiffness.amax() > 0.0 || on_track.damping.amax() > 0.0;
        Ok(Self {
            step_s,
            method,
            surface: SurfaceConstants {
                shear_modulus_pa: contact.shear_modulus_pa(),
                normal_damping_s_per_m: contact.normal_damping_s_per_m(),
            },
            contact,
            level,
            names: bodies.iter().map(|body| body.name.clone()).collect(),
            stands: bodies
                .iter()
                .map(|body| Stand {
                    x_m: body.x_m,
                    height_m: body.height_m,
                })
                .collect(),
            wheelsets,
            inertia: (0..inertia.len() / N)
                .map(|body| std::array::from_fn(|i| inertia[N * body + i]))
                .collect(),
            springs: Springs::new(&stiffness, &damping),
            on_track: is_held.then(|| Springs::new(&on_track.stiffness, &on_track.damping)),
            structure,
            system,
            dampers,
            stops,
        })
    }

    /// The vehicle as it stands on straight level track, its middle at `distance_m`, in motion at `speed_m_per_s`.
    ///
    /// # Errors
    /// A speed or distance out of bounds.
    pub fn at_rest(
        &self,
        track: &Track,
        distance_m: f64,
        speed_m_per_s: f64,
    ) -> Result<VehicleState, VehicleError> {
        VehicleError::check("vehicle", "speed_m_per_s", speed_m_per_s, SPEED_M_PER_S)?;
        VehicleError::check("vehicle", "distance_m", distance_m, [-1e6, 1e6])?;
        let places = self.inertia.len();
        let zeros = vec![[0.0; N]; places];
        let mut guidance = Guidance::new(places);
        guidance.update(track.layout(), distance_m, speed_m_per_s, &self.stands);
        let mut state = VehicleState {
            bodies: self.names.len(),
            ticks: 0,
            distance_m,
            speed_m_per_s,
            coordinates: zeros.clone(),
            velocities: guidance.pose_rate.clone(),
            accelerations: zeros.clone(),
            last_accelerations: zeros.clone(),
            forces: zeros.clone(),
            inertia: self.inertia.clone(),
            pose: guidance.pose.clone(),
            contacts: vec![WheelsetForces::default(); self.wheelsets.len()],
            dampers: self.dampers_at_rest(&zeros),
            damper_displacements_m: vec![0.0; self.dampers.len()],
            damper_forces_n: vec![0.0; self.dampers.len()],
            outside_forces_n: vec![None; self.dampers.len()],
            stop_forces_n: vec![0.0; self.stops.len()],
            is_diverged: false,
            work: Work {
                guidance,
                system: self.system.clone(),
                residual: zeros.clone(),
                in_middle: zeros.clone(),
                rates_in_middle: zeros.clone(),
                tick_forces: zeros.clone(),
                tick_changes: zeros,
                target_damper_forces_n: vec![0.0; self.dampers.len()],
                target_stop_forces_n: vec![0.0; self.stops.len()],
            },
        };
        self.begin(&mut state, track);
        Ok(state)
    }

    /// Moves a body at the start: adds `displacement` to its coordinates, and has the track and the rails act there.
    pub fn displace(
        &self,
        state: &mut VehicleState,
        track: &Track,
        body: usize,
        displacement: [f64; N],
    ) {
        if body < self.names.len() {
            let coordinates = &mut state.coordinates[body];
            for (coordinate, by) in coordinates.iter_mut().zip(displacement) {
                *coordinate += by;
            }
        }
        state.dampers = self.dampers_at_rest(&state.coordinates);
        self.begin(state, track);
    }

    /// Step size, s.
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Length of the steps inside a tick, s.
    pub fn inner_step_s(&self) -> f64 {
        self.method.step_s
    }

    /// Names of the bodies, those of the wheelsets after them.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of wheelsets.
    pub fn wheelsets(&self) -> usize {
        self.wheelsets.len()
    }

    /// Names of the dampers.
    pub fn damper_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.dampers.iter().map(|element| element.name.as_str())
    }

    /// Another damper in the place of one: a state goes on with it from its next step, its force carries over.
    ///
    /// # Errors
    /// Parameters that are refused; a number that is no damper's.
    pub fn set_damper(
        &mut self,
        damper: usize,
        parameters: &DamperParameters,
    ) -> Result<(), VehicleError> {
        let step_s = self.step_s;
        let dampers = self.dampers.len();
        let Some(element) = self.dampers.get_mut(damper) else {
            return Err(VehicleError::NoSuchDamper { damper, dampers });
        };
        element.damper = build(&element.name, parameters, step_s)?;
        Ok(())
    }
}

fn build(
    element: &str,
    parameters: &DamperParameters,
    step_s: f64,
) -> Result<Damper<f64>, VehicleError> {
    parameters
        .build(step_s)
        .map_err(|source| VehicleError::Damper {
            element: element.to_owned(),
            source: Box::new(source),
        })
}
