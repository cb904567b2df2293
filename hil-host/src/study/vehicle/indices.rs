//! Indices of a run: what is told of it in a few numbers.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::vehicle::VehicleState;
use serde::Serialize;

use super::ride::{Ride, RideIndices};
use super::signals::{SIDES, load_n};
use crate::files::case::Case;

/// Distance over which wheel forces are averaged, m.
const WINDOW_M: f64 = 2.0;

/// Indices of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Indices {
    /// Time that they are of, s.
    pub duration_s: f64,
    /// Bodies.
    pub bodies: Vec<BodyIndices>,
    /// Ride of the car body.
    pub ride: Vec<RideIndices>,
    /// Wheelsets.
    pub wheelsets: Vec<WheelsetIndices>,
    /// Greatest magnitude of each damper's force, N.
    pub greatest_damper_forces_n: Vec<f64>,
}

/// Accelerations of a body at its centre of gravity, across the track.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyIndices {
    /// Name.
    pub body: String,
    /// Root mean square of the lateral acceleration, m/s^2.
    pub lateral_rms_m_per_s2: f64,
    /// Greatest magnitude of the lateral acceleration, m/s^2.
    pub lateral_greatest_m_per_s2: f64,
    /// Root mean square of the vertical acceleration, m/s^2.
    pub vertical_rms_m_per_s2: f64,
    /// Greatest magnitude of the vertical acceleration, m/s^2.
    pub vertical_greatest_m_per_s2: f64,
}

/// Forces of a wheelset.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelsetIndices {
    /// Name.
    pub wheelset: String,
    /// Root mean square of the lateral force of both rails on it, N.
    pub lateral_force_rms_n: f64,
    /// Greatest magnitude of its mean over 2 m, N.
    pub lateral_force_greatest_n: f64,
    /// Mean power that creep dissipates over the speed: the wear number, N.
    pub wear_number_n: f64,
    /// The left and the right wheel.
    pub wheels: Vec<WheelIndices>,
}

/// Forces of a wheel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelIndices {
    /// Side.
    pub side: &'static str,
    /// Greatest mean of `Y/Q` over 2 m, dimensionless.
    pub derailment_greatest: f64,
    /// Root mean square of `Y/Q`, dimensionless.
    pub derailment_rms: f64,
    /// Least load, N.
    pub load_least_n: f64,
    /// Greatest load, N.
    pub load_greatest_n: f64,
}

/// Sums up indices tick by tick.
#[derive(Debug, Clone)]
pub struct Indexer {
    ticks: u64,
    step_s: f64,
    ride: Ride,
    bodies: Vec<(String, [Spread; 2])>,
    wheelsets: Vec<Wheelset>,
    dampers: Vec<f64>,
}

#[derive(Debug, Clone)]
struct Wheelset {
    name: String,
    lateral: Windowed,
    wear: f64,
    derailment: [Windowed; 2],
    least: [f64; 2],
    greatest: [f64; 2],
}

/// Square and greatest magnitude.
#[derive(Debug, Clone, Copy, Default)]
struct Spread {
    square: f64,
    greatest: f64,
}

/// Square, and greatest mean over a window of ticks.
#[derive(Debug, Clone)]
struct Windowed {
    square: f64,
    greatest: f64,
    ring: Vec<f64>,
    /// Sum of the ring.
    sum: f64,
    next: usize,
    seen: usize,
}

impl Spread {
    fn add(&mut self, value: f64) {
        self.square += value * value;
        self.greatest = self.greatest.max(value.abs());
    }
}

impl Windowed {
    fn new(ticks: usize) -> Self {
        Self {
            square: 0.0,
            greatest: 0.0,
            ring: vec![0.0; ticks],
            sum: 0.0,
            next: 0,
            seen: 0,
        }
    }

    fn add(&mut self, value: f64) {
        self.square += value * value;
        self.sum += value - self.ring[self.next];
        self.ring[self.next] = value;
        self.next = (self.next + 1) % self.ring.len();
        self.seen += 1;
        if self.seen >= self.ring.len() {
            let mean = self.sum / self.ring.len() as f64;
            self.greatest = self.greatest.max(mean.abs());
        }
    }
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
        let window = ((WINDOW_M / (speed_m_per_s * step_s)).round() as usize).max(1);
        Self {
            ticks: 0,
            step_s: *step_s,
            ride: Ride::new(vehicle, *step_s),
            bodies: vehicle
                .bodies
                .iter()
                .map(|body| (body.name.clone(), [Spread::default(); 2]))
                .collect(),
            wheelsets: vehicle
                .wheelsets
                .iter()
                .map(|wheelset| Wheelset {
                    name: wheelset.name.clone(),
                    lateral: Windowed::new(window),
                    wear: 0.0,
                    derailment: [Windowed::new(window), Windowed::new(window)],
                    least: [f64::INFINITY; 2],
                    greatest: [0.0; 2],
                })
                .collect(),
            dampers: vec![0.0; vehicle.dampers().count()],
        }
    }

    /// Adds the state after a tick.
    pub fn add(&mut self, state: &VehicleState) {
        let accelerations = |body| state.acceleration(body);
        self.add_of(
            accelerations,
            state.contacts(),
            state.damper_forces_n(),
            state.speed_m_per_s(),
        );
    }

    /// Adds accelerations of bodies, forces on wheelsets and of dampers.
    pub fn add_of(
        &mut self,
        acceleration: impl Fn(usize) -> [f64; 5],
        contacts: &[WheelsetForces],
        damper_forces_n: &[f64],
        speed_m_per_s: f64,
    ) {
        self.ticks += 1;
        self.ride.add(acceleration(0));
        for (number, (_, spreads)) in self.bodies.iter_mut().enumerate() {
            for (spread, value) in spreads.iter_mut().zip(acceleration(number)) {
                spread.add(value);
            }
        }
        for (wheelset, contact) in self.wheelsets.iter_mut().zip(contacts) {
            wheelset.lateral.add(contact.force_n[1]);
            let patches = contact
                .wheels
                .iter()
                .flat_map(|wheel| wheel.loaded_patches());
            wheelset.wear += patches.map(|patch| patch.dissipation_w).sum::<f64>() / speed_m_per_s;
            for (side, coefficient) in contact.derailment_coefficients().into_iter().enumerate() {
                let load = load_n(contact, side);
                wheelset.derailment[side].add(coefficient);
                wheelset.least[side] = wheelset.least[side].min(load);
                wheelset.greatest[side] = wheelset.greatest[side].max(load);
            }
        }
        for (greatest, force) in self.dampers.iter_mut().zip(damper_forces_n) {
            *greatest = greatest.max(force.abs());
        }
    }

    /// What has been summed up; none of no tick.
    pub fn indices(&self) -> Option<Indices> {
        if self.ticks == 0 {
            return None;
        }
        let rms = |square: f64| (square / self.ticks as f64).sqrt();
        let wheel = |wheelset: &Wheelset, side: usize| WheelIndices {
            side: SIDES[side],
            derailment_greatest: wheelset.derailment[side].greatest,
            derailment_rms: rms(wheelset.derailment[side].square),
            load_least_n: wheelset.least[side],
            load_greatest_n: wheelset.greatest[side],
        };
        Some(Indices {
            duration_s: self.ticks as f64 * self.step_s,
            bodies: self
                .bodies
                .iter()
                .map(|(name, [lateral, vertical])| BodyIndices {
                    body: name.clone(),
                    lateral_rms_m_per_s2: rms(lateral.square),
                    lateral_greatest_m_per_s2: lateral.greatest,
                    vertical_rms_m_per_s2: rms(vertical.square),
                    vertical_greatest_m_per_s2: vertical.greatest,
                })
                .collect(),
            ride: self.ride.indices(),
            wheelsets: self
                .wheelsets
                .iter()
                .map(|wheelset| WheelsetIndices {
                    wheelset: wheelset.name.clone(),
                    lateral_force_rms_n: rms(wheelset.lateral.square),
                    lateral_force_greatest_n: wheelset.lateral.greatest,
                    wear_number_n: wheelset.wear / self.ticks as f64,
                    wheels: vec![wheel(wheelset, 0), wheel(wheelset, 1)],
                })
                .collect(),
            greatest_damper_forces_n: self.dampers.clone(),
        })
    }
}
