//! Real-time simulation of a vehicle: constants, state, and a step of constant cost.

mod across;
mod assembly;
mod block;
mod columns;
mod copy;
mod dampers;
mod elementwise;
mod energy;
mod extremes;
mod forces;
mod friction;
mod guidance;
mod identity;
mod influences;
mod initial;
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

use dashpot_core::{Damper, DamperParameters, VectorWidth};
use fearless_simd::Level;

use self::across::{DamperElement, StopElement};
use self::assembly::build;
use self::block::Vector;
pub use self::energy::Energy;
pub use self::extremes::Extremes;
use self::friction::FrictionElement;
use self::guidance::BodyPosition;
pub use self::guidance::CANT_BASE_M;
use self::identity::Identity;
pub use self::influences::{FRICTION_FACTOR, MAX_APPLIED};
use self::method::Method;
use self::rail_equations::RailEquations;
pub use self::rails::RailSupport;
use self::shape::Shape;
use self::springs::Springs;
pub use self::state::{Stop, VehicleState};
use self::structure::{Blocks, Structure};
use self::tangent::SurfaceConstants;
use super::carried::Carried;
use super::error::VehicleError;
use crate::contact::{PatchSource, Tables, WheelsetContact};
use crate::creep::CreepLaw;

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
    /// Vectors with which the dampers are stepped.
    width: VectorWidth,
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
