//! Real-time simulation of a vehicle: constants, state, and a step of constant cost.

mod across;
mod assembly;
mod block;
mod columns;
mod dampers;
mod elementwise;
mod energy;
mod extremes;
mod forces;
mod friction;
mod guidance;
mod identity;
mod influences;
mod integration;
mod method;
mod rail_equations;
mod rails;
mod shape;
mod springs;
mod state;
mod step;
mod structure;
mod tangent;

use std::sync::Arc;

use dashpot_core::{Damper, DamperParameters};
use fearless_simd::Level;

use self::across::{DamperElement, StopElement};
use self::assembly::build;
use self::block::{N, Vector};
pub use self::energy::Energy;
pub use self::extremes::Extremes;
use self::friction::FrictionElement;
pub use self::guidance::CANT_BASE_M;
use self::guidance::{BodyPosition, Guidance};
use self::identity::Identity;
pub use self::influences::{FRICTION_FACTOR, MAX_APPLIED};
use self::integration::MAX_DISPLACEMENT;
use self::method::Method;
use self::rail_equations::RailEquations;
pub use self::rails::RailSupport;
use self::shape::Shape;
use self::springs::Springs;
use self::state::Work;
pub use self::state::{Stop, VehicleState};
use self::structure::{Blocks, Structure};
use self::tangent::SurfaceConstants;
use super::body::COORDINATES;
use super::carried::Carried;
use super::error::VehicleError;
use crate::contact::{PatchSource, Tables, WheelsetContact, WheelsetForces};
use crate::creep::CreepLaw;
use crate::track::Track;

/// Bounds of the tick of a [`Vehicle`], s.
pub const STEP_S: [f64; 2] = [0.02e-3, 2e-3];

/// Bounds of the speed of a [`Vehicle`], m/s.
pub const SPEED_M_PER_S: [f64; 2] = [1.0, 150.0];

/// A vehicle for real-time simulation: constants for one step size, shared by any number of states.
///
/// ```
/// # use std::sync::Arc;
/// # use dashpot_rail::contact::{ContactGeometry, Installation, Pair, Steel, Tables, WheelsetContact};
/// # use dashpot_rail::creep::{Friction, KalkerBook};
/// use dashpot_rail::track::Track;
/// use dashpot_rail::vehicle::{Body, Element, End, Law, Vehicle, VehicleParameters, Wheelset};
/// # let pair = Pair::standard(Installation::default().with_wheel_radius_m(0.46))?;
/// # let tables = Tables::new(ContactGeometry::new(pair, Steel::default())?);
/// # let contact = Arc::new(WheelsetContact::new(Arc::new(tables), KalkerBook::new(), Friction::default())?);
/// // A wagon of 27 t on two wheelsets of 1.5 t; `contact` is the contact of its wheels.
/// let wheelset = |name: &str| Wheelset::new(name, 1500.0, [800.0, 100.0, 800.0], 0.46);
/// let spring = |on: &str, x: f64, y: f64| {
///     let ends = [End::body(on, [x, y, 0.46]), End::body("body", [x, y, 0.46])];
///     let law = Law::SpringDamper {
///         stiffness_n_per_m: [5e6, 5e6, 1e6],
///         damping_n_s_per_m: [0.0, 0.0, 20e3],
///     };
///     Element::new(format!("{on} spring {y}"), ends, law)
/// };
/// let wagon = VehicleParameters::new("wagon")
///     .with_bodies([Body::new("body", 27e3, [40e3, 800e3, 800e3], 1.5)])
///     .with_wheelsets([wheelset("front").with_x_m(4.0), wheelset("rear").with_x_m(-4.0)])
///     .with_elements([
///         spring("front", 4.0, 1.0), spring("front", 4.0, -1.0),
///         spring("rear", -4.0, 1.0), spring("rear", -4.0, -1.0),
///     ]);
/// let vehicle = Vehicle::new(&wagon, contact, 1e-3)?;
/// let track = Track::default();
/// let mut state = vehicle.at_rest(&track, 0.0, 20.0)?;
/// for _ in 0..500 {
///     vehicle.step(&mut state, &track);
/// }
/// assert!((state.distance_m() - 10.0).abs() < 1e-9);
/// let carried: f64 = state.contacts().iter().map(|contact| -contact.force_n[2]).sum();
/// assert!((carried / (30e3 * 9.81) - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Vehicle<L, S: PatchSource = Tables> {
    identity: Identity,
    /// Shape of its states.
    shape: Shape,
    step_s: f64,
    method: Method,
    /// Contact of each wheelset; equal wheelsets share one.
    contacts: Vec<Arc<WheelsetContact<L, S>>>,
    level: Level,
    names: Vec<String>,
    positions: Vec<BodyPosition>,
    wheelsets: Vec<WheelsetConstants>,
    inertia: Vec<Vector>,
    springs: Springs,
    structure: Structure,
    /// `M` plus weighted damping and stiffness: the equations of a step without the contact.
    system: Blocks,
    /// The same for elastically supported rails.
    rails: Vec<RailEquations>,
    /// Springs and dashpots to the track; `None` if there are none.
    on_track: Option<Springs>,
    dampers: Vec<DamperElement>,
    stops: Vec<StopElement>,
    frictions: Vec<FrictionElement>,
}

/// Indices of the bodies that a wheelset's contact acts on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ContactBodies {
    wheelset: usize,
    /// Rails, if they are elastically supported.
    rails: Option<usize>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct WheelsetConstants {
    bodies: ContactBodies,
    surface: SurfaceConstants,
    /// Forces on elastically supported rails at standstill, N.
    standing_n: Vector,
    carried: Carried,
    axle_load_n: f64,
    spin_inertia_kg_m2: f64,
}

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Returns the state in which the bodies have their equilibrium positions on straight level track. The vehicle runs
    /// at `speed_m_per_s`, with its middle at `distance_m`.
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
        let mut state = self.undisplaced(distance_m, speed_m_per_s);
        let guidance = &mut state.work.guidance;
        guidance.update(track.layout(), distance_m, speed_m_per_s, &self.positions);
        state.velocities.clone_from(&guidance.pose_rate);
        state.pose.clone_from(&guidance.pose);
        self.begin(&mut state, track);
        Ok(state)
    }

    /// Returns a state on straight level track without contact forces.
    fn undisplaced(&self, distance_m: f64, speed_m_per_s: f64) -> VehicleState {
        let count = self.inertia.len();
        let zeros = vec![[0.0; N]; count];
        VehicleState {
            identity: self.identity,
            bodies: self.names.len(),
            ticks: 0,
            distance_m,
            speed_m_per_s,
            coordinates: zeros.clone(),
            velocities: zeros.clone(),
            accelerations: zeros.clone(),
            last_accelerations: zeros.clone(),
            forces: zeros.clone(),
            inertia: self.inertia.clone(),
            pose: zeros.clone(),
            contacts: vec![WheelsetForces::default(); self.wheelsets.len()],
            dampers: self.dampers_at_rest(&zeros),
            damper_displacements_m: vec![0.0; self.dampers.len()],
            damper_velocities_m_per_s: vec![0.0; self.dampers.len()],
            damper_forces_n: vec![0.0; self.dampers.len()],
            outside_forces_n: vec![None; self.dampers.len()],
            friction_factor: 1.0,
            applied: zeros.clone(),
            stop_forces_n: vec![0.0; self.stops.len()],
            friction_forces_n: vec![0.0; self.frictions.len()],
            sliders_m: vec![0.0; self.frictions.len()],
            is_diverged: false,
            met_other_vehicle: false,
            work: Work {
                guidance: Guidance::new(count),
                system: self.system.clone(),
                rails: self.rails.clone(),
                residual: zeros.clone(),
                in_middle: zeros.clone(),
                rates_in_middle: zeros.clone(),
                tick_forces: zeros.clone(),
                tick_changes: zeros,
                target_damper_forces_n: vec![0.0; self.dampers.len()],
                target_stop_forces_n: vec![0.0; self.stops.len()],
                target_friction_forces_n: vec![0.0; self.frictions.len()],
                extremes: vec![Extremes::default(); self.wheelsets.len()],
            },
        }
    }

    /// Returns true if a state belongs to a vehicle with the same bodies, elements, step and rails as this one. The
    /// parameters of dampers and the contact may differ. A deserialised state may belong to any vehicle, or to none.
    #[inline]
    pub fn can_step(&self, state: &VehicleState) -> bool {
        state.identity == self.identity && state.shape() == self.shape
    }

    fn check_state(&self, state: &VehicleState) -> Result<(), VehicleError> {
        if self.can_step(state) {
            Ok(())
        } else {
            Err(VehicleError::OtherVehicle)
        }
    }

    /// Displaces a body before the first step: adds `displacement` to its coordinates and updates all forces. Dampers
    /// and friction elements are without force in the new position.
    ///
    /// # Errors
    /// An index out of range, a displacement outside -10 to 10 m or rad, or a state of another vehicle. The state is
    /// then unchanged.
    pub fn displace(
        &self,
        state: &mut VehicleState,
        track: &Track,
        body: usize,
        displacement: [f64; N],
    ) -> Result<(), VehicleError> {
        self.check_state(state)?;
        let bodies = self.names.len();
        let Some(name) = self.names.get(body) else {
            return Err(VehicleError::NoSuchBodyIndex { body, bodies });
        };
        let allowed = [-MAX_DISPLACEMENT, MAX_DISPLACEMENT];
        for (coordinate, change) in COORDINATES.iter().zip(displacement) {
            VehicleError::check(name, coordinate.name(), change, allowed)?;
        }
        for (coordinate, change) in state.coordinates[body].iter_mut().zip(displacement) {
            *coordinate += change;
        }
        state.dampers = self.dampers_at_rest(&state.coordinates);
        self.begin(state, track);
        Ok(())
    }

    /// Returns the length of a tick, s.
    pub fn step_s(&self) -> f64 {
        self.step_s
    }

    /// Returns the length of the steps inside a tick, s.
    pub fn inner_step_s(&self) -> f64 {
        self.method.step_s
    }

    /// Returns the names of the bodies, followed by those of the wheelsets.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Returns the number of wheelsets.
    pub fn wheelsets(&self) -> usize {
        self.wheelsets.len()
    }

    /// Returns the names of the dampers.
    pub fn damper_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.dampers.iter().map(|element| element.name.as_str())
    }

    /// Returns the names of the friction elements.
    pub fn friction_names(&self) -> impl ExactSizeIterator<Item = &str> {
        self.frictions.iter().map(|element| element.name.as_str())
    }

    /// Returns the load of each wheelset on the rails at standstill, N.
    pub fn axle_loads_n(&self) -> impl ExactSizeIterator<Item = f64> {
        self.wheelsets.iter().map(|wheelset| wheelset.axle_load_n)
    }

    /// Builds a damper for [`replace_damper`](Self::replace_damper).
    ///
    /// Building takes much longer than a tick and allocates, so a real-time run builds its dampers before it starts.
    ///
    /// # Errors
    /// The same as for [`set_damper`](Self::set_damper).
    pub fn build_damper(
        &self,
        damper: usize,
        parameters: &DamperParameters,
    ) -> Result<Damper<f64>, VehicleError> {
        let dampers = self.dampers.len();
        let element = self.dampers.get(damper);
        let element = element.ok_or(VehicleError::NoSuchDamper { damper, dampers })?;
        build(&element.name, parameters, self.step_s)
    }

    /// Replaces a damper as [`set_damper`](Self::set_damper) does, with a damper built by
    /// [`build_damper`](Self::build_damper). Does not allocate.
    ///
    /// # Errors
    /// An index out of range.
    pub fn replace_damper(
        &mut self,
        damper: usize,
        replacement: &Damper<f64>,
    ) -> Result<(), VehicleError> {
        let dampers = self.dampers.len();
        match self.dampers.get_mut(damper) {
            Some(element) => {
                element.damper = *replacement;
                Ok(())
            }
            None => Err(VehicleError::NoSuchDamper { damper, dampers }),
        }
    }

    /// Replaces a damper. States use it from their next step on, and the damper's force stays continuous.
    ///
    /// # Errors
    /// Invalid parameters or an index out of range.
    pub fn set_damper(
        &mut self,
        damper: usize,
        parameters: &DamperParameters,
    ) -> Result<(), VehicleError> {
        let built = self.build_damper(damper, parameters)?;
        self.replace_damper(damper, &built)
    }
}
