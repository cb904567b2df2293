//! Indices of a run: accelerations, ride, safety against derailment, wear, damper forces.

mod body;
mod nadal;
mod ride;
mod sums;
mod wheel;
mod wheelset;

pub use body::{BodyIndices, UnbalancedIndices};
use body::{BodySums, unbalanced};
use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::vehicle::Standstill;
pub use nadal::{Nadal, NadalWheel};
use ride::Ride;
pub use ride::{RideError, RideIndices, check_ride};
use serde::Serialize;
use sums::Statistics;
pub use wheel::WheelIndices;
pub use wheelset::WheelsetIndices;
use wheelset::WheelsetSums;

use super::VehicleTick;
use dashpot_files::case::Case;

/// Distance over which wheel forces are averaged, m.
pub const WINDOW_M: f64 = 2.0;

/// Indices of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Indices {
    /// Duration covered by the indices, s.
    pub duration_s: f64,
    /// Accelerations of each body.
    pub bodies: Vec<BodyIndices>,
    /// Unbalanced lateral acceleration of the track.
    pub unbalanced: UnbalancedIndices,
    /// Ride at each measurement point.
    pub ride: Vec<RideIndices>,
    /// Distance over which wheel and wheelset forces are averaged, m.
    pub window_m: f64,
    /// Nadal's limit of `Y/Q`; the lowest if wheels have different limits.
    pub nadal: Nadal,
    /// Nadal's limits of all wheels: one for each distinct wheel profile and friction.
    pub nadal_limits: Vec<Nadal>,
    /// Forces of each wheelset.
    pub wheelsets: Vec<WheelsetIndices>,
    /// Maximum magnitude of each damper's force, N.
    pub greatest_damper_forces_n: Vec<f64>,
}

/// Accumulates the indices of a run tick by tick.
#[derive(Debug, Clone)]
pub struct Indexer {
    ticks: u64,
    step_s: f64,
    tick_m: f64,
    nadal: Vec<Nadal>,
    bodies: Vec<BodySums>,
    unbalanced: Statistics,
    /// `None` if the ride indices are not defined for this step size.
    ride: Option<Ride>,
    wheelsets: Vec<WheelsetSums>,
    dampers: Vec<f64>,
}

/// Values of one tick from which indices are computed.
#[derive(Debug, Clone, Copy)]
pub struct Sample<'a, A: Fn(usize) -> [f64; 5]> {
    /// Returns the accelerations of a body, in the order of its coordinates, m/s^2 and rad/s^2; see
    /// [`VehicleTick::acceleration`].
    pub acceleration: A,
    /// Unbalanced lateral acceleration of the track under the first body, m/s^2; see
    /// [`VehicleTick::unbalanced_m_per_s2`].
    pub unbalanced_m_per_s2: f64,
    /// Contact forces of each wheelset.
    pub contacts: &'a [WheelsetForces],
    /// Force of each damper, N.
    pub damper_forces_n: &'a [f64],
}

impl Indexer {
    /// Starts the indices of a case.
    pub fn new(case: &Case) -> Self {
        let Case {
            vehicle,
            step_s,
            speed_m_per_s,
            ..
        } = case;
        let tick_m = speed_m_per_s * step_s;
        let window = ((WINDOW_M / tick_m).round() as usize).max(1);
        let (nadal, nadal_of) = Nadal::of_case(case);
        // Every vehicle that can run has an equilibrium at standstill; without one, loads are not compared with it.
        let standstill = Standstill::new(vehicle).ok();
        let axle_load_n = |index: usize| {
            let standstill = standstill.as_ref()?;
            standstill.axle_loads_n().get(index).copied()
        };
        let wheelsets = vehicle.wheelsets.iter().enumerate();
        let bodies = vehicle.bodies.iter();
        Self {
            ticks: 0,
            step_s: *step_s,
            tick_m,
            bodies: bodies.map(|body| BodySums::new(&body.name)).collect(),
            unbalanced: Statistics::default(),
            ride: Ride::new(vehicle, *step_s).ok(),
            wheelsets: wheelsets
                .map(|(index, wheelset)| {
                    let limits = nadal_of[index].map(|of_wheel| nadal[of_wheel].limit);
                    WheelsetSums::new(&wheelset.name, axle_load_n(index), window, limits)
                })
                .collect(),
            nadal,
            dampers: vec![0.0; vehicle.dampers().count()],
        }
    }

    /// Adds a tick of the vehicle.
    pub fn add(&mut self, state: &impl VehicleTick) {
        self.add_sample(&Sample {
            acceleration: |body| state.acceleration(body),
            unbalanced_m_per_s2: state.unbalanced_m_per_s2(),
            contacts: state.contacts(),
            damper_forces_n: state.damper_forces_n(),
        });
    }

    /// Adds a tick given by its values; bodies, wheelsets and dampers are those of the case.
    pub fn add_sample<A: Fn(usize) -> [f64; 5]>(&mut self, sample: &Sample<A>) {
        self.ticks += 1;
        let speed_m_per_s = self.tick_m / self.step_s;
        if let Some(ride) = &mut self.ride {
            ride.add(&sample.acceleration);
        }
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.add((sample.acceleration)(index));
        }
        self.unbalanced.add(sample.unbalanced_m_per_s2);
        for (wheelset, contact) in self.wheelsets.iter_mut().zip(sample.contacts) {
            wheelset.add(contact, speed_m_per_s);
        }
        for (greatest, force) in self.dampers.iter_mut().zip(sample.damper_forces_n) {
            *greatest = greatest.max(force.abs());
        }
    }

    /// Returns the indices of all ticks so far; `None` before the first tick, or if the vehicle has no wheelsets.
    pub fn indices(&self) -> Option<Indices> {
        if self.ticks == 0 {
            return None;
        }
        let lowest = self.nadal.iter();
        let lowest = lowest.min_by(|a, b| a.limit.total_cmp(&b.limit))?;
        let ride = self.ride.as_ref();
        let wheelsets = self.wheelsets.iter();
        Some(Indices {
            duration_s: self.ticks as f64 * self.step_s,
            bodies: self.bodies.iter().map(BodySums::indices).collect(),
            unbalanced: unbalanced(&self.unbalanced),
            ride: ride.map(Ride::indices).unwrap_or_default(),
            window_m: WINDOW_M,
            nadal: lowest.clone(),
            nadal_limits: self.nadal.clone(),
            wheelsets: wheelsets
                .map(|wheelset| wheelset.indices(self.tick_m))
                .collect(),
            greatest_damper_forces_n: self.dampers.clone(),
        })
    }
}
