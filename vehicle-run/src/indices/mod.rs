//! Indices of a run: accelerations, ride, safety against derailment, wear, damper forces.

mod body;
mod filtered;
mod limits;
mod nadal;
mod ride;
mod sums;
mod wheel;
mod wheelset;

pub use body::{BodyIndices, UnbalancedIndices};
use body::{BodySums, unbalanced};
use dashpot_rail::vehicle::Standstill;
pub use filtered::filtered_names;
pub use limits::Judged;
pub use nadal::{Nadal, NadalWheel};
use ride::Ride;
pub use ride::{RideError, RideIndices, check_ride};
use serde::Serialize;
use sums::Statistics;
pub(crate) use sums::Travelled;
pub use wheel::WheelIndices;
pub use wheelset::WheelsetIndices;
use wheelset::WheelsetSums;

use super::VehicleTick;
use dashpot_files::case::Case;

/// Distance over which wheel forces are averaged, m.
pub const WINDOW_M: f64 = 2.0;

/// Corner frequency of the low-pass of wheel forces, Hz.
pub const FILTER_HZ: f64 = 20.0;

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
    /// Corner frequency of the low-pass of filtered forces, Hz.
    pub filter_hz: f64,
    /// Nadal's limit of `Y/Q`; the lowest if wheels have different limits.
    pub nadal: Nadal,
    /// Nadal's limits of all wheels: one for each distinct wheel profile and friction.
    pub nadal_limits: Vec<Nadal>,
    /// Forces of each wheelset.
    pub wheelsets: Vec<WheelsetIndices>,
    /// Forces relative to their limits.
    pub limits: Vec<Judged>,
    /// Maximum magnitude of each damper's force, N.
    pub greatest_damper_forces_n: Vec<f64>,
}

/// Accumulates the indices of a run tick by tick.
#[derive(Debug, Clone)]
pub struct Indexer {
    count: u64,
    ticks: Ticks,
    nadal: Vec<Nadal>,
    bodies: Vec<BodySums>,
    unbalanced: Statistics,
    /// `None` if the ride indices are not defined for this step size.
    ride: Option<Ride>,
    wheelsets: Vec<WheelsetSums>,
    dampers: Vec<f64>,
}

/// Length of the ticks of a run.
#[derive(Debug, Clone, Copy)]
struct Ticks {
    step_s: f64,
    /// Speed in the current tick, m/s.
    speed_m_per_s: f64,
    least_speed_m_per_s: f64,
    greatest_speed_m_per_s: f64,
    /// Ticks in a window of [`WINDOW_M`] at the current speed.
    window: usize,
}

impl Ticks {
    /// The first tick of a case.
    pub fn new(case: &Case) -> Self {
        let speeds = case.speeds_m_per_s();
        Self {
            step_s: case.step_s,
            speed_m_per_s: case.speed_m_per_s,
            least_speed_m_per_s: speeds.min(),
            greatest_speed_m_per_s: speeds.max(),
            window: window(case.speed_m_per_s * case.step_s),
        }
    }

    /// Goes on to a tick.
    pub fn go_on(&mut self, tick: &impl VehicleTick) {
        let speed_m_per_s = tick.speed_m_per_s();
        if speed_m_per_s != self.speed_m_per_s {
            self.speed_m_per_s = speed_m_per_s;
            self.window = window(self.tick_m());
        }
    }

    /// Distance of a tick, m.
    fn tick_m(&self) -> f64 {
        self.speed_m_per_s * self.step_s
    }

    /// Ticks in a window of [`WINDOW_M`] at the current speed.
    pub fn window(&self) -> usize {
        self.window
    }

    /// Ticks in a window of [`WINDOW_M`] at the least speed.
    pub fn longest_window(&self) -> usize {
        window(self.least_speed_m_per_s * self.step_s)
    }
}

/// Ticks of a length in a window of [`WINDOW_M`].
fn window(tick_m: f64) -> usize {
    ((WINDOW_M / tick_m).round() as usize).max(1)
}

impl Indexer {
    /// Starts the indices of a case.
    pub fn new(case: &Case) -> Self {
        let Case {
            vehicle, step_s, ..
        } = case;
        let ticks = Ticks::new(case);
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
            count: 0,
            ticks,
            bodies: bodies.map(|body| BodySums::new(&body.name)).collect(),
            unbalanced: Statistics::default(),
            ride: Ride::new(vehicle, *step_s).ok(),
            wheelsets: wheelsets
                .map(|(index, wheelset)| {
                    let limits = nadal_of[index].map(|of_wheel| nadal[of_wheel].limit);
                    WheelsetSums::new(&wheelset.name, axle_load_n(index), &ticks, limits)
                })
                .collect(),
            nadal,
            dampers: vec![0.0; vehicle.dampers().count()],
        }
    }

    /// Adds a tick of the vehicle.
    pub fn add(&mut self, tick: &impl VehicleTick) {
        self.count += 1;
        self.ticks.go_on(tick);
        if let Some(ride) = &mut self.ride {
            ride.add(|body| tick.acceleration(body));
        }
        for (index, body) in self.bodies.iter_mut().enumerate() {
            body.add(tick.acceleration(index));
        }
        self.unbalanced.add(tick.unbalanced_m_per_s2());
        let contacts = tick.contacts().iter().zip(tick.extremes());
        for (wheelset, (contact, extremes)) in self.wheelsets.iter_mut().zip(contacts) {
            wheelset.add(contact, extremes, &self.ticks);
        }
        for (greatest, force) in self.dampers.iter_mut().zip(tick.damper_forces_n()) {
            *greatest = greatest.max(force.abs());
        }
    }

    /// Returns the indices of all ticks so far; `None` before the first tick, or if the vehicle has no wheelsets.
    pub fn indices(&self) -> Option<Indices> {
        if self.count == 0 {
            return None;
        }
        let lowest = self.nadal.iter();
        let lowest = lowest.min_by(|a, b| a.limit.total_cmp(&b.limit))?;
        let ride = self.ride.as_ref();
        let wheelsets = self.wheelsets.iter();
        let wheelsets: Vec<WheelsetIndices> = wheelsets
            .map(|wheelset| wheelset.indices(&self.ticks))
            .collect();
        Some(Indices {
            duration_s: self.count as f64 * self.ticks.step_s,
            bodies: self.bodies.iter().map(BodySums::indices).collect(),
            unbalanced: unbalanced(&self.unbalanced),
            ride: ride.map(Ride::indices).unwrap_or_default(),
            window_m: WINDOW_M,
            filter_hz: FILTER_HZ,
            nadal: lowest.clone(),
            nadal_limits: self.nadal.clone(),
            limits: limits::judged(&wheelsets),
            wheelsets,
            greatest_damper_forces_n: self.dampers.clone(),
        })
    }
}
