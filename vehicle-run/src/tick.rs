//! Read access to a vehicle after a tick: its state itself, or a copy for another thread.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::vehicle::{Extremes, VehicleState};

/// Vehicle after a tick. Bodies are in the order of the parameters; wheelsets follow them.
pub trait VehicleTick {
    /// Position of the vehicle's middle along the track, m.
    fn distance_m(&self) -> f64;
    /// Speed during the tick, m/s.
    fn speed_m_per_s(&self) -> f64;
    /// Factor on the friction of all wheels during the tick.
    fn friction_factor(&self) -> f64;
    /// Returns the coordinates of each body and wheelset; see [`VehicleState::coordinates`].
    fn coordinates(&self) -> &[[f64; 5]];
    /// Returns the accelerations of a body, m/s^2 and rad/s^2; see [`VehicleState::acceleration`].
    fn acceleration(&self, body: usize) -> [f64; 5];
    /// Unbalanced lateral acceleration of the track under the first body, positive to the right, m/s^2.
    fn unbalanced_m_per_s2(&self) -> f64;
    /// Returns the contact forces of each wheelset; see [`VehicleState::contacts`].
    fn contacts(&self) -> &[WheelsetForces];
    /// Extremes of each wheelset within the tick; see [`VehicleState::extremes`].
    fn extremes(&self) -> &[Extremes];
    /// Displacement of each damper, m; see [`VehicleState::damper_displacements_m`].
    fn damper_displacements_m(&self) -> &[f64];
    /// Mean velocity of each damper during the tick, m/s; see [`VehicleState::damper_velocities_m_per_s`].
    fn damper_velocities_m_per_s(&self) -> &[f64];
    /// Force of each damper, N; see [`VehicleState::damper_forces_n`].
    fn damper_forces_n(&self) -> &[f64];
    /// Force of each friction element, N; see [`VehicleState::friction_forces_n`].
    fn friction_forces_n(&self) -> &[f64];
}

impl VehicleTick for VehicleState {
    fn distance_m(&self) -> f64 {
        self.distance_m()
    }
    fn speed_m_per_s(&self) -> f64 {
        self.speed_m_per_s()
    }
    fn friction_factor(&self) -> f64 {
        self.friction_factor()
    }
    fn coordinates(&self) -> &[[f64; 5]] {
        self.coordinates()
    }
    fn acceleration(&self, body: usize) -> [f64; 5] {
        self.acceleration(body)
    }
    fn unbalanced_m_per_s2(&self) -> f64 {
        -self.track_acceleration(0)[0]
    }
    fn contacts(&self) -> &[WheelsetForces] {
        self.contacts()
    }
    fn extremes(&self) -> &[Extremes] {
        self.extremes()
    }
    fn damper_displacements_m(&self) -> &[f64] {
        self.damper_displacements_m()
    }
    fn damper_velocities_m_per_s(&self) -> &[f64] {
        self.damper_velocities_m_per_s()
    }
    fn damper_forces_n(&self) -> &[f64] {
        self.damper_forces_n()
    }
    fn friction_forces_n(&self) -> &[f64] {
        self.friction_forces_n()
    }
}

/// Copy of the reported values of one tick, about 10 kB for a locomotive.
#[derive(Debug, Clone, PartialEq)]
pub struct TickRecord {
    /// Time since the start of the run, s.
    pub time_s: f64,
    distance_m: f64,
    speed_m_per_s: f64,
    friction_factor: f64,
    unbalanced_m_per_s2: f64,
    coordinates: Vec<[f64; 5]>,
    accelerations: Vec<[f64; 5]>,
    contacts: Vec<WheelsetForces>,
    extremes: Vec<Extremes>,
    damper_displacements_m: Vec<f64>,
    damper_velocities_m_per_s: Vec<f64>,
    damper_forces_n: Vec<f64>,
    friction_forces_n: Vec<f64>,
}

impl TickRecord {
    /// Copies `state`, the state of the vehicle `time_s` after the start of the run.
    pub fn new(time_s: f64, state: &VehicleState) -> Self {
        let bodies = state.coordinates().len();
        Self {
            time_s,
            distance_m: state.distance_m(),
            speed_m_per_s: state.speed_m_per_s(),
            friction_factor: state.friction_factor(),
            unbalanced_m_per_s2: state.unbalanced_m_per_s2(),
            coordinates: state.coordinates().to_vec(),
            accelerations: (0..bodies).map(|body| state.acceleration(body)).collect(),
            contacts: state.contacts().to_vec(),
            extremes: state.extremes().to_vec(),
            damper_displacements_m: state.damper_displacements_m().to_vec(),
            damper_velocities_m_per_s: state.damper_velocities_m_per_s().to_vec(),
            damper_forces_n: state.damper_forces_n().to_vec(),
            friction_forces_n: state.friction_forces_n().to_vec(),
        }
    }

    /// Replaces the extremes, by those of several short ticks that together are this one.
    pub fn with_extremes(mut self, extremes: Vec<Extremes>) -> Self {
        self.extremes = extremes;
        self
    }

    /// Overwrites the record with a later state of the same run, without allocating.
    ///
    /// # Panics
    /// If the record belongs to another vehicle.
    pub fn copy(&mut self, time_s: f64, state: &VehicleState) {
        self.time_s = time_s;
        self.distance_m = state.distance_m();
        self.speed_m_per_s = state.speed_m_per_s();
        self.friction_factor = state.friction_factor();
        self.unbalanced_m_per_s2 = state.unbalanced_m_per_s2();
        self.coordinates.copy_from_slice(state.coordinates());
        for (body, acceleration) in self.accelerations.iter_mut().enumerate() {
            *acceleration = state.acceleration(body);
        }
        self.contacts.copy_from_slice(state.contacts());
        self.extremes.copy_from_slice(state.extremes());
        self.damper_displacements_m
            .copy_from_slice(state.damper_displacements_m());
        self.damper_velocities_m_per_s
            .copy_from_slice(state.damper_velocities_m_per_s());
        self.damper_forces_n
            .copy_from_slice(state.damper_forces_n());
        self.friction_forces_n
            .copy_from_slice(state.friction_forces_n());
    }
}

impl VehicleTick for TickRecord {
    fn distance_m(&self) -> f64 {
        self.distance_m
    }
    fn speed_m_per_s(&self) -> f64 {
        self.speed_m_per_s
    }
    fn friction_factor(&self) -> f64 {
        self.friction_factor
    }
    fn coordinates(&self) -> &[[f64; 5]] {
        &self.coordinates
    }
    fn acceleration(&self, body: usize) -> [f64; 5] {
        self.accelerations[body]
    }
    fn unbalanced_m_per_s2(&self) -> f64 {
        self.unbalanced_m_per_s2
    }
    fn contacts(&self) -> &[WheelsetForces] {
        &self.contacts
    }
    fn extremes(&self) -> &[Extremes] {
        &self.extremes
    }
    fn damper_displacements_m(&self) -> &[f64] {
        &self.damper_displacements_m
    }
    fn damper_velocities_m_per_s(&self) -> &[f64] {
        &self.damper_velocities_m_per_s
    }
    fn damper_forces_n(&self) -> &[f64] {
        &self.damper_forces_n
    }
    fn friction_forces_n(&self) -> &[f64] {
        &self.friction_forces_n
    }
}
