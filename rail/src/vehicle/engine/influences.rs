//! Changes of a running vehicle: speed, friction, and forces on bodies.

use super::block::{N, Vector};
use super::state::VehicleState;
use super::{SPEED_M_PER_S, Vehicle};
use crate::contact::PatchSource;
use crate::creep::CreepLaw;
use crate::vehicle::body::COORDINATES;
use crate::vehicle::error::VehicleError;

/// Bounds of the friction factor of a [`VehicleState`], dimensionless.
pub const FRICTION_FACTOR: [f64; 2] = [0.0, 5.0];

/// Maximum magnitude of an applied force, N, or moment, N m.
pub const MAX_APPLIED: f64 = 1e8;

impl VehicleState {
    /// Returns the factor by which the friction of all wheels is multiplied, 1 at the start.
    pub fn friction_factor(&self) -> f64 {
        self.friction_factor
    }

    /// Returns the applied force and moment on a body, in the order of its coordinates, N and N m.
    ///
    /// # Panics
    /// If the index of the body is out of range.
    pub fn applied(&self, body: usize) -> [f64; N] {
        self.applied[body]
    }

    /// Changes the speed from the next tick on, m/s.
    ///
    /// The wheels keep rolling: a drive or brake is assumed that changes their rotation without a force on the rails.
    /// There are no forces along the track, so change the speed in small steps, as a vehicle would.
    ///
    /// # Errors
    /// A speed outside [`SPEED_M_PER_S`]. The state is then unchanged.
    pub fn set_speed_m_per_s(&mut self, speed_m_per_s: f64) -> Result<(), VehicleError> {
        VehicleError::check("vehicle", "speed_m_per_s", speed_m_per_s, SPEED_M_PER_S)?;
        self.speed_m_per_s = speed_m_per_s;
        Ok(())
    }

    /// Multiplies the friction of all wheels by a factor from the next tick on.
    ///
    /// # Errors
    /// A factor outside [`FRICTION_FACTOR`]. The state is then unchanged.
    pub fn set_friction_factor(&mut self, factor: f64) -> Result<(), VehicleError> {
        VehicleError::check("vehicle", "friction_factor", factor, FRICTION_FACTOR)?;
        self.friction_factor = factor;
        Ok(())
    }

    /// Applies a force and a moment to the centre of a body from the next tick on, in the order of its coordinates, N
    /// and N m: lateral force to the right, downward force, and moments that increase roll, pitch and yaw.
    ///
    /// # Errors
    /// An index out of range, or a value that is not finite or above [`MAX_APPLIED`]. The state is then unchanged.
    pub fn apply(&mut self, body: usize, force: [f64; N]) -> Result<(), VehicleError> {
        let bodies = self.bodies;
        if body >= bodies {
            return Err(VehicleError::NoSuchBodyIndex { body, bodies });
        }
        for (coordinate, value) in COORDINATES.iter().zip(force) {
            let allowed = [-MAX_APPLIED, MAX_APPLIED];
            VehicleError::check("applied force", coordinate.name(), value, allowed)?;
        }
        self.applied[body] = force;
        Ok(())
    }

    /// Adds the applied forces to those at the start of the tick; they are constant during a tick.
    #[inline(always)]
    pub(super) fn add_applied(&mut self) {
        let forces = self.work.tick_forces.as_flattened_mut().iter_mut();
        for (force, applied) in forces.zip(self.applied.as_flattened()) {
            *force += applied;
        }
    }
}

impl<L: CreepLaw, S: PatchSource> Vehicle<L, S> {
    /// Returns the force and moment about a body's centre of a force `[lateral, downward]`, N, that acts at a point:
    /// metres forward from the middle of the vehicle, to the right, and above the top of the rails. `None` if there is
    /// no such body.
    pub fn about_centre(
        &self,
        body: usize,
        at_m: [f64; 3],
        [lateral_n, downward_n]: [f64; 2],
    ) -> Option<[f64; N]> {
        let position = self
            .positions
            .get(body)
            .filter(|_| body < self.names.len())?;
        let [x, y, height] = [at_m[0] - position.x_m, at_m[1], at_m[2] - position.height_m];
        let roll = y * downward_n + height * lateral_n;
        let moments = Vector::from([lateral_n, downward_n, roll, -x * downward_n, x * lateral_n]);
        Some(moments)
    }
}
