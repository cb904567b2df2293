//! Linear equations of a vehicle that runs on straight track at constant speed.

use nalgebra::{DMatrix, DVector};

use super::body::{Body, COORDINATES};
use super::carried::Carried;
use super::error::VehicleError;
use super::linear::Linear;
use super::modes::{self, Mode};
use super::parameters::VehicleParameters;
use super::standstill::{Standstill, attach, wheelset_bodies};
use crate::contact::{
    PatchSource, RailDisplacement, WheelDerivatives, WheelsetContact, WheelsetForces,
};
use crate::creep::CreepLaw;

/// A vehicle that runs on straight track at constant speed, linearised about its central position. The derivatives of
/// the contact forces and the gyroscopic moments of the wheelsets are included.
#[derive(Debug, Clone)]
pub struct Running {
    bodies: Vec<Body>,
    linear: Linear,
}

/// A linear vehicle without one of its dampers, `x' = A x - b f` and `e = c x`: the extension `e` (m) of the damper and
/// its force `f` (N), positive if it resists extension.
#[derive(Debug, Clone, PartialEq)]
pub struct WithoutDamper {
    /// `A`, 1/s.
    pub state_matrix: DMatrix<f64>,
    /// `b`: minus the change of the state's derivative per newton.
    pub input: DVector<f64>,
    /// `c`: extension per unit of each state.
    pub output: DVector<f64>,
    /// Damping of the damper in small motion: secant of its characteristic at 0.1 mm/s.
    pub damping_n_s_per_m: f64,
    /// Stiffness of the mounts in series.
    pub stiffness_n_per_m: f64,
}

/// Index of the field of [`Motion`](crate::contact::Motion) for each coordinate of a wheelset. The spin enters only
/// through its rate.
const DISPLACEMENT_FIELDS: [Option<usize>; COORDINATES.len()] =
    [Some(1), Some(2), Some(3), None, Some(4)];

/// Index of the field of [`Motion`](crate::contact::Motion) for the rate of each coordinate, and its sign. The spin
/// rate has the opposite sign, because rolling forward is a rotation nose down.
const RATE_FIELDS: [(usize, f64); COORDINATES.len()] =
    [(5, 1.0), (6, 1.0), (7, 1.0), (8, -1.0), (9, 1.0)];

/// Bounds of the speed, m/s.
const SPEED_M_PER_S: [f64; 2] = [0.1, 200.0];

/// Linearised contact of a centred wheelset at the height at which the rails carry its load.
struct Central {
    derivatives: [WheelDerivatives; 2],
    rotation_rad_per_s: f64,
}

impl Running {
    /// Linearises the vehicle at `speed_m_per_s` with `contact` on all wheelsets. Friction elements stick.
    ///
    /// # Errors
    /// Those of [`Standstill::new`], a speed out of bounds, or a wheelset that the rails cannot carry.
    pub fn new<L: CreepLaw, S: PatchSource>(
        vehicle: &VehicleParameters,
        contact: &WheelsetContact<L, S>,
        speed_m_per_s: f64,
    ) -> Result<Self, VehicleError> {
        let contacts = vec![contact; vehicle.wheelsets.len()];
        Self::with_contacts(vehicle, &contacts, speed_m_per_s)
    }

    /// Linearises the vehicle like [`Running::new`], with a contact for each wheelset.
    ///
    /// # Errors
    /// Those of [`Running::new`], or the number of contacts differs from that of the wheelsets.
    pub fn with_contacts<L: CreepLaw, S: PatchSource>(
        vehicle: &VehicleParameters,
        contacts: &[&WheelsetContact<L, S>],
        speed_m_per_s: f64,
    ) -> Result<Self, VehicleError> {
        if contacts.len() != vehicle.wheelsets.len() {
            return Err(VehicleError::Contacts {
                contacts: contacts.len(),
                wheelsets: vehicle.wheelsets.len(),
            });
        }
        VehicleError::check(&vehicle.name, "speed_m_per_s", speed_m_per_s, SPEED_M_PER_S)?;
        let standstill = Standstill::new(vehicle)?;
        let mut bodies = vehicle.bodies.clone();
        bodies.extend(wheelset_bodies(vehicle));
        let mut linear = Linear::new(&bodies);
        let ends = attach(vehicle, true)?;
        for (element, (ends, line)) in vehicle.elements.iter().zip(&ends) {
            linear.add(element, ends, *line);
            linear.add_sticking(element, ends);
        }
        for ((ends, _), force) in ends.iter().zip(standstill.forces()) {
            linear.add_preload(ends, *force);
        }
        // Most wheelsets have the same contact and carry the same load as the previous one.
        let mut previous: Option<(usize, f64, Central)> = None;
        for (number, wheelset) in vehicle.wheelsets.iter().enumerate() {
            let load_n = standstill.axle_loads_n()[number];
            let contact = contacts[number];
            let is_same = |(number, load, _): &(usize, f64, Central)| {
                std::ptr::eq(contacts[*number], contact) && (load - load_n).abs() < 1e-9 * load
            };
            let central = match previous.take_if(|previous| is_same(previous)) {
                Some((.., central)) => central,
                None => Central::new(contact, speed_m_per_s, load_n).ok_or_else(|| {
                    VehicleError::NotCarried {
                        wheelset: wheelset.name.clone(),
                        load_n,
                    }
                })?,
            };
            let first = COORDINATES.len() * (vehicle.bodies.len() + number);
            central.add_to(&mut linear, first);
            // The angular momentum about the axle turns with the axle: roll rate causes a yaw moment, and vice versa.
            let momentum = wheelset.inertia_kg_m2[1] * central.rotation_rad_per_s;
            linear.damping[(first + 2, first + 4)] += momentum;
            linear.damping[(first + 4, first + 2)] -= momentum;
            previous = Some((number, load_n, central));
        }
        Ok(Self { bodies, linear })
    }

    /// Returns the oscillating modes of bodies and wheelsets in order of frequency. Overdamped motion is not a mode.
    ///
    /// # Errors
    /// Equations with a non-finite value, or an eigenvalue iteration that does not converge (no such case is known).
    pub fn modes(&self) -> Result<Vec<Mode>, VehicleError> {
        modes::oscillating(&self.linear, &self.bodies)
    }

    /// Returns the real and imaginary parts of all eigenvalues, rad/s, including those of motion that does not
    /// oscillate. Conjugate pairs are adjacent.
    ///
    /// # Errors
    /// The same as for [`Self::modes`].
    pub fn eigenvalues_rad_per_s(&self) -> Result<Vec<[f64; 2]>, VehicleError> {
        modes::eigenvalues_rad_per_s(&self.linear)
    }

    /// Returns the rows of the state matrix `A` of `x' = A x`. The states are the velocities of all bodies, the
    /// displacements of the dashpots in series with springs, and the coordinates that a force depends on, in m, rad and
    /// s.
    pub fn state_matrix(&self) -> Vec<Vec<f64>> {
        modes::state_matrix(&self.linear)
    }

    /// Returns the vehicle without damper `number`, counted from 0 in the order of the vehicle's damper elements, and
    /// the two parameters of that damper. `None` if the vehicle has fewer dampers.
    pub fn without_damper(&self, number: usize) -> Option<WithoutDamper> {
        let damper = self.linear.series.get(number)?;
        let (state_matrix, input, output) = self.linear.without(number);
        Some(WithoutDamper {
            state_matrix,
            input,
            output,
            damping_n_s_per_m: damper.damping,
            stiffness_n_per_m: damper.stiffness,
        })
    }
}

impl Central {
    fn new<L: CreepLaw, S: PatchSource>(
        contact: &WheelsetContact<L, S>,
        speed: f64,
        load: f64,
    ) -> Option<Self> {
        let carried = Carried::new(contact, load)?;
        let motion = carried.motion(speed);
        let mut forces = WheelsetForces::default();
        let rails = [RailDisplacement::default(); 2];
        let derivatives = contact.update_with_derivatives(&motion, &rails, &mut forces);
        Some(Self {
            derivatives,
            rotation_rad_per_s: motion.rotation_rad_per_s,
        })
    }

    /// Adds the contact's stiffness and damping to the wheelset whose coordinates start at `first`.
    fn add_to(&self, linear: &mut Linear, first: usize) {
        let derivative = |component: usize, field: usize| -> f64 {
            self.derivatives
                .iter()
                .map(|wheel| match component {
                    0 => wheel.force[1][field],
                    1 => wheel.force[2][field],
                    _ => wheel.moment[component - 2][field],
                })
                .sum()
        };
        for row in 0..COORDINATES.len() {
            for column in 0..COORDINATES.len() {
                if let Some(field) = DISPLACEMENT_FIELDS[column] {
                    linear.stiffness[(first + row, first + column)] -= derivative(row, field);
                }
                let (field, sign) = RATE_FIELDS[column];
                linear.damping[(first + row, first + column)] -= sign * derivative(row, field);
            }
        }
    }
}
