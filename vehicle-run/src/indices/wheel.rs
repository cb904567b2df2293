//! Indices of a wheel: derailment coefficient, load and lift.

use dashpot_rail::indices::wheel_unloading;
use serde::Serialize;

use super::sums::{Longest, Windowed};
use crate::signals::SIDES;

/// Indices of a wheel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelIndices {
    /// Side, `left` or `right`.
    pub side: &'static str,
    /// Maximum magnitude of the mean of `Y/Q` over 2 m, dimensionless.
    pub derailment_greatest: f64,
    /// Root mean square of `Y/Q`, dimensionless.
    pub derailment_rms: f64,
    /// Maximum mean of `Y/Q` over 2 m in the direction of flange climbing, divided by Nadal's limit, dimensionless; 0
    /// if `Y/Q` never has this direction.
    pub derailment_over_nadal: f64,
    /// Longest distance over which `Y/Q` stays above Nadal's limit, m.
    pub longest_over_nadal_m: f64,
    /// Minimum load, N.
    pub load_least_n: f64,
    /// Maximum load, N.
    pub load_greatest_n: f64,
    /// Load at standstill, half the axle load, N.
    pub load_static_n: Option<f64>,
    /// Maximum unloading `(Q0 - Q)/Q0` relative to the load `Q0` at standstill, dimensionless; 1 if the wheel lifts.
    pub unloading_greatest: Option<f64>,
    /// Maximum unloading of the mean load over 2 m, dimensionless.
    pub unloading_of_mean_greatest: Option<f64>,
    /// Share of the time during which the wheel is lifted, dimensionless.
    pub lifted_share: f64,
}

/// Accumulated forces of a wheel.
#[derive(Debug, Clone)]
pub(super) struct WheelSums {
    derailment: Windowed,
    load: Windowed,
    min_load_n: f64,
    ticks: u64,
    lifted: u64,
    nadal: f64,
    over_nadal: Longest,
}

impl WheelSums {
    /// Starts with windows of `window` ticks and Nadal's limit `nadal`.
    pub fn new(window: usize, nadal: f64) -> Self {
        Self {
            derailment: Windowed::new(window),
            load: Windowed::new(window),
            min_load_n: f64::INFINITY,
            ticks: 0,
            lifted: 0,
            nadal,
            over_nadal: Longest::default(),
        }
    }

    /// Adds a tick: `Y/Q` and the load `Q`, N.
    pub fn add(&mut self, derailment: f64, load_n: f64) {
        self.ticks += 1;
        self.derailment.add(derailment);
        self.load.add(load_n);
        self.min_load_n = self.min_load_n.min(load_n);
        self.lifted += u64::from(load_n <= 0.0);
        self.over_nadal.add(derailment > self.nadal);
    }

    pub fn indices(&self, side: usize, static_n: Option<f64>, tick_m: f64) -> WheelIndices {
        let min_mean_load_n = self.load.means().map(|means| means.min);
        let climbing = self.derailment.means().map_or(0.0, |means| means.max);
        let unloading = |load_n| Some(wheel_unloading(static_n?, load_n));
        WheelIndices {
            side: SIDES[side],
            derailment_greatest: self.derailment.max_mean_magnitude(),
            derailment_rms: self.derailment.statistics().rms(),
            derailment_over_nadal: climbing.max(0.0) / self.nadal,
            longest_over_nadal_m: self.over_nadal.ticks() as f64 * tick_m,
            load_least_n: self.min_load_n,
            load_greatest_n: self.load.statistics().max_magnitude(),
            load_static_n: static_n,
            unloading_greatest: unloading(self.min_load_n),
            unloading_of_mean_greatest: min_mean_load_n.and_then(unloading),
            lifted_share: self.lifted as f64 / self.ticks as f64,
        }
    }
}
