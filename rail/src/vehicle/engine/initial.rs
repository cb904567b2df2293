//! States before the first step.

use super::block::N;
use super::extremes::{Extremes, LastLoads};
use super::guidance::Guidance;
use super::integration::MAX_DISPLACEMENT;
use super::state::{VehicleState, Work};
use super::{SPEED_M_PER_S, Vehicle};
use crate::contact::{PatchSource, WheelsetForces};
use crate::creep::CreepLaw;
use crate::track::Track;
use crate::vehicle::body::COORDINATES;
use crate::vehicle::error::VehicleError;

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
    pub(super) fn undisplaced(&self, distance_m: f64, speed_m_per_s: f64) -> VehicleState {
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
            last_loads: vec![LastLoads::default(); self.wheelsets.len()],
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
}
