//! Indices of a run: what is told of it in a few numbers, one kind a file.

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
pub use nadal::Nadal;
use ride::Ride;
pub use ride::{NoRide, RideIndices, check_ride};
use serde::Serialize;
use sums::Spread;
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
    /// Time that they are of, s.
    pub duration_s: f64,
    /// Bodies.
    pub bodies: Vec<BodyIndices>,
    /// What the cant leaves of the centripetal acceleration.
    pub unbalanced: UnbalancedIndices,
    /// Ride at points of the vehicle.
    pub ride: Vec<RideIndices>,
    /// Distance over which forces of wheels and wheelsets are averaged, m.
    pub window_m: f64,
    /// Limit of `Y/Q`.
    pub nadal: Nadal,
    /// Wheelsets.
    pub wheelsets: Vec<WheelsetIndices>,
    /// Greatest magnitude of each damper's force, N.
    pub greatest_damper_forces_n: Vec<f64>,
}

/// Sums up indices tick by tick.
#[derive(Debug, Clone)]
pub struct Indexer {
    ticks: u64,
    step_s: f64,
    tick_m: f64,
    nadal: Nadal,
    bodies: Vec<BodySums>,
    unbalanced: Spread,
    /// None at a step that there is no index of ride for.
    ride: Option<Ride>,
    wheelsets: Vec<WheelsetSums>,
    dampers: Vec<f64>,
}

/// What indices are of in a tick.
#[derive(Debug, Clone, Copy)]
pub struct Sample<'a, A: Fn(usize) -> [f64; 5]> {
    /// Acceleration of each body, in the order of its coordinates, as [`VehicleTick::acceleration`] has it, m/s^2 and rad/s^2.
    pub acceleration: A,
    /// Unbalanced lateral acceleration of the track under the first body, m/s^2: as [`VehicleTick::unbalanced_m_per_s2`] has it.
    pub unbalanced_m_per_s2: f64,
    /// Forces on wheelsets.
    pub contacts: &'a [WheelsetForces],
    /// Forces of dampers, N.
    pub damper_forces_n: &'a [f64],
}

impl Indexer {
    /// Of the vehicle of a case.
    pub fn new(case: &Case) -> Self {
        let Case {
            vehicle,
            step_s,
            speed_m_per_s,
            ..
        } = case;
        let tick_m = speed_m_per_s * step_s;
        let window = ((WINDOW_M / tick_m).round() as usize).max(1);
        let nadal = Nadal::new(case.friction);
        // A vehicle that runs stands; of one that does not nothing is compared with the load at standstill.
        let standstill = Standstill::new(vehicle).ok();
        let load_n = |number: usize| {
            let standstill = standstill.as_ref()?;
            standstill.axle_loads_n().get(number).copied()
        };
        let wheelsets = vehicle.wheelsets.iter().enumerate();
        let bodies = vehicle.bodies.iter();
        Self {
            ticks: 0,
            step_s: *step_s,
            tick_m,
            nadal,
            bodies: bodies.map(|body| BodySums::new(&body.name)).collect(),
            unbalanced: Spread::default(),
            ride: Ride::new(vehicle, *step_s).ok(),
            wheelsets: wheelsets
                .map(|(number, wheelset)| {
                    WheelsetSums::new(&wheelset.name, load_n(number), window, nadal.limit)
                })
                .collect(),
            dampers: vec![0.0; vehicle.dampers().count()],
        }
    }

    /// Adds the vehicle after a tick.
    pub fn add(&mut self, state: &impl VehicleTick) {
        self.add_sample(&Sample {
            acceleration: |body| state.acceleration(body),
            unbalanced_m_per_s2: state.unbalanced_m_per_s2(),
            contacts: state.contacts(),
            damper_forces_n: state.damper_forces_n(),
        });
    }

    /// Adds a tick of any vehicle like that of the case.
    pub fn add_sample<A: Fn(usize) -> [f64; 5]>(&mut self, sample: &Sample<A>) {
        self.ticks += 1;
        let speed_m_per_s = self.tick_m / self.step_s;
        if let Some(ride) = &mut self.ride {
            ride.add(&sample.acceleration);
        }
        for (number, body) in self.bodies.iter_mut().enumerate() {
            body.add((sample.acceleration)(number));
        }
        self.unbalanced.add(sample.unbalanced_m_per_s2);
        for (wheelset, contact) in self.wheelsets.iter_mut().zip(sample.contacts) {
            wheelset.add(contact, speed_m_per_s);
        }
        for (greatest, force) in self.dampers.iter_mut().zip(sample.damper_forces_n) {
            *greatest = greatest.max(force.abs());
        }
    }

    /// What has been summed up; none of no tick.
    pub fn indices(&self) -> Option<Indices> {
        if self.ticks == 0 {
            return None;
        }
        let ride = self.ride.as_ref();
        let wheelsets = self.wheelsets.iter();
        Some(Indices {
            duration_s: self.ticks as f64 * self.step_s,
            bodies: self.bodies.iter().map(BodySums::indices).collect(),
            unbalanced: unbalanced(&self.unbalanced),
            ride: ride.map(Ride::indices).unwrap_or_default(),
            window_m: WINDOW_M,
            nadal: self.nadal,
            wheelsets: wheelsets
                .map(|wheelset| wheelset.indices(self.tick_m))
                .collect(),
            greatest_damper_forces_n: self.dampers.clone(),
        })
    }
}
