//! A vehicle that runs on straight track at constant speed, linear about its central position.

use super::body::{Body, COORDINATES, VehicleParameters};
use super::carried::Carried;
use super::error::VehicleError;
use super::linear::Linear;
use super::modes::{self, Mode};
use super::standstill::{Standstill, places, wheelset_bodies};
use crate::contact::{
    PatchSource, RailDisplacement, WheelDerivatives, WheelsetContact, WheelsetForces,
};
use crate::creep::CreepLaw;

/// A vehicle that runs on straight track at constant speed, linear about its central position: the contact by its derivatives
/// there, the wheelsets with their gyroscopic moments.
#[derive(Debug, Clone)]
pub struct Running {
    bodies: Vec<Body>,
    linear: Linear,
}

/// Fields of [`Motion`](crate::contact::Motion) by each coordinate of a wheelset, in the order of the coordinates; the spin only by its rate.
const DISPLACED: [Option<usize>; COORDINATES.len()] = [Some(1), Some(2), Some(3), None, Some(4)];

/// Fields of [`Motion`](crate::contact::Motion) by the rate of each coordinate, and the sign: rolling forward is nose down.
const RATES: [(usize, f64); COORDINATES.len()] =
    [(5, 1.0), (6, 1.0), (7, 1.0), (8, -1.0), (9, 1.0)];

/// Bounds of the speed, m/s.
const SPEED_M_PER_S: [f64; 2] = [0.1, 200.0];

/// What a centred wheelset has of the contact at the height at which the rails carry its load.
struct Central {
    derivatives: [WheelDerivatives; 2],
    rotation_rad_per_s: f64,
}

impl Running {
    /// The vehicle at `speed_m_per_s`, all wheelsets with `contact`.
    ///
    /// # Errors
    /// As [`Standstill::new`]; a speed out of bounds; a wheelset that the rails of `contact` do not carry.
    pub fn new<L: CreepLaw, S: PatchSource>(
        vehicle: &VehicleParameters,
        contact: &WheelsetContact<L, S>,
        speed_m_per_s: f64,
    ) -> Result<Self, VehicleError> {
        VehicleError::check(&vehicle.name, "speed_m_per_s", speed_m_per_s, SPEED_M_PER_S)?;
        let standstill = Standstill::new(vehicle)?;
        let mut bodies = vehicle.bodies.clone();
        bodies.extend(wheelset_bodies(vehicle));
        let mut linear = Linear::new(&bodies);
        let ends = places(vehicle, true)?;
        for (element, (places, line)) in vehicle.elements.iter().zip(&ends) {
            linear.add(element, places, *line);
        }
        for ((places, _), force) in ends.iter().zip(standstill.forces()) {
            linear.add_preload(places, *force);
        }
        // Most wheelsets have the load of the one before.
        let mut last: Option<(f64, Central)> = None;
        for (number, wheelset) in vehicle.wheelsets.iter().enumerate() {
            let load_n = standstill.axle_loads_n()[number];
            let is_same = |(load, _): &(f64, Central)| (load - load_n).abs() < 1e-9 * load;
            let central = match last.take_if(|last| is_same(last)) {
                Some((_, central)) => central,
                None => Central::new(contact, speed_m_per_s, load_n).ok_or_else(|| {
                    VehicleError::NotCarried {
                        wheelset: wheelset.name.clone(),
                        load_n,
                    }
                })?,
            };
            let first = COORDINATES.len() * (vehicle.bodies.len() + number);
            central.add_to(&mut linear, first);
            // The angular momentum about the axle turns with it: roll rate gives yaw moment and the other way round.
            let momentum = wheelset.inertia_kg_m2[1] * central.rotation_rad_per_s;
            linear.damping[(first + 2, first + 4)] += momentum;
            linear.damping[(first + 4, first + 2)] -= momentum;
            last = Some((load_n, central));
        }
        Ok(Self { bodies, linear })
    }

    /// Modes of bodies and wheelsets by rising frequency; overdamped motion is none.
    ///
    /// # Errors
    /// Equations with a number that is not finite; an iteration for the eigenvalues that does not converge, which is not known to happen.
    pub fn modes(&self) -> Result<Vec<Mode>, VehicleError> {
        modes::of(&self.linear, &self.bodies)
    }

    /// All eigenvalues, real and imaginary part, rad/s: also those of motion that does not oscillate. A pair of conjugates is adjacent.
    ///
    /// # Errors
    /// As [`Self::modes`].
    pub fn eigenvalues_rad_per_s(&self) -> Result<Vec<[f64; 2]>, VehicleError> {
        modes::all(&self.linear)
    }

    /// Rows of the state matrix `A` of `x' = A x`. The states are the velocities of all bodies, the displacements of the dashpots in
    /// series with springs, and the coordinates that a force depends on, m, rad and s.
    pub fn state_matrix(&self) -> Vec<Vec<f64>> {
        modes::rows(&self.linear)
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

    /// Stiffness and damping of the contact on the wheelset whose coordinates begin at `first`.
    fn add_to(&self, linear: &mut Linear, first: usize) {
        let by = |component: usize, field: usize| -> f64 {
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
                if let Some(field) = DISPLACED[column] {
                    linear.stiffness[(first + row, first + column)] -= by(row, field);
                }
                let (field, sign) = RATES[column];
                linear.damping[(first + row, first + column)] -= sign * by(row, field);
            }
        }
    }
}
