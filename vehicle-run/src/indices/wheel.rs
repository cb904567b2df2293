//! Indices of a wheel: derailment coefficient, load and lift.

use dashpot_rail::indices::{LowPass, wheel_load_limit_n, wheel_unloading};
use serde::Serialize;

use super::sums::{Longest, Range, Statistics, Windowed};
use super::{FILTER_HZ, Ticks};
use crate::signals::SIDES;

/// Indices of a wheel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelIndices {
    /// Side, `left` or `right`.
    pub side: &'static str,
    /// Maximum magnitude of the mean over 2 m of `Y/Q`, filtered at 20 Hz, dimensionless.
    pub derailment_greatest: f64,
    /// Root mean square of `Y/Q`, dimensionless.
    pub derailment_rms: f64,
    /// Maximum mean of the filtered `Y/Q` over 2 m in the direction of flange climbing, dimensionless; 0 if `Y/Q` never
    /// has this direction.
    pub derailment_climbing: f64,
    /// `derailment_climbing` divided by Nadal's limit, dimensionless.
    pub derailment_over_nadal: f64,
    /// Longest distance over which `Y/Q` stays above Nadal's limit, m.
    pub longest_over_nadal_m: f64,
    /// Minimum load in any step inside a tick, N.
    pub load_least_n: f64,
    /// Maximum load in any step inside a tick, N.
    pub load_greatest_n: f64,
    /// Minimum load, filtered at 20 Hz, N.
    pub filtered_load_least_n: f64,
    /// Maximum load, filtered at 20 Hz, N.
    pub filtered_load_greatest_n: f64,
    /// Load at standstill, half the axle load, N.
    pub load_static_n: Option<f64>,
    /// Limit of the filtered load for the load at standstill and the greatest speed, N; see [`wheel_load_limit_n`].
    pub load_limit_n: Option<f64>,
    /// Maximum filtered load divided by its limit, dimensionless.
    pub load_over_limit: Option<f64>,
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
    derailment: Statistics,
    derailment_filter: LowPass,
    /// Averaged over 2 m.
    pub filtered_derailment: Windowed,
    load_n: Range,
    load_filter: LowPass,
    /// Filtered load of the last tick, N.
    pub filtered_load_n: f64,
    filtered_loads_n: Range,
    mean_load: Windowed,
    ticks: u64,
    lifted: u64,
    nadal: f64,
    over_nadal: Longest,
}

/// Values of a wheel in a tick.
pub(super) struct WheelTick {
    /// `Y/Q` at the end of the tick.
    pub derailment: f64,
    /// Load at the end of the tick, N.
    pub load_n: f64,
    /// Range of the load in the tick, N.
    pub loads_n: Range,
}

impl WheelSums {
    /// Starts with Nadal's limit `nadal`.
    pub fn new(ticks: &Ticks, nadal: f64) -> Self {
        let filter = LowPass::new(FILTER_HZ, 1.0 / ticks.step_s);
        Self {
            derailment: Statistics::default(),
            derailment_filter: filter.clone(),
            filtered_derailment: Windowed::new(ticks.longest_window()),
            load_n: Range::NONE,
            load_filter: filter,
            filtered_load_n: 0.0,
            filtered_loads_n: Range::NONE,
            mean_load: Windowed::new(ticks.longest_window()),
            ticks: 0,
            lifted: 0,
            nadal,
            over_nadal: Longest::default(),
        }
    }

    pub fn add(&mut self, tick: &WheelTick, ticks: &Ticks) {
        let WheelTick {
            derailment,
            load_n,
            loads_n,
        } = *tick;
        let window = ticks.window();
        self.ticks += 1;
        self.derailment.add(derailment);
        self.filtered_derailment
            .add(self.derailment_filter.next(derailment), window);
        self.load_n.add(loads_n.min);
        self.load_n.add(loads_n.max);
        self.filtered_load_n = self.load_filter.next(load_n);
        self.filtered_loads_n.add(self.filtered_load_n);
        self.mean_load.add(load_n, window);
        self.lifted += u64::from(load_n <= 0.0);
        self.over_nadal.add(derailment > self.nadal, ticks.tick_m());
    }

    pub fn indices(&self, side: usize, static_n: Option<f64>, ticks: &Ticks) -> WheelIndices {
        let min_mean_load_n = self.mean_load.means().map(|means| means.min);
        let climbing = self
            .filtered_derailment
            .means()
            .map_or(0.0, |means| means.max.max(0.0));
        let unloading = |load_n| Some(wheel_unloading(static_n?, load_n));
        let limit_n =
            static_n.map(|load_n| wheel_load_limit_n(load_n, ticks.greatest_speed_m_per_s));
        WheelIndices {
            side: SIDES[side],
            derailment_greatest: self.filtered_derailment.max_mean_magnitude(),
            derailment_rms: self.derailment.rms(),
            derailment_climbing: climbing,
            derailment_over_nadal: climbing / self.nadal,
            longest_over_nadal_m: self.over_nadal.metres(),
            load_least_n: self.load_n.min,
            load_greatest_n: self.load_n.max,
            filtered_load_least_n: self.filtered_loads_n.min,
            filtered_load_greatest_n: self.filtered_loads_n.max,
            load_static_n: static_n,
            load_limit_n: limit_n,
            load_over_limit: limit_n.map(|limit_n| self.filtered_loads_n.max / limit_n),
            unloading_greatest: unloading(self.load_n.min),
            unloading_of_mean_greatest: min_mean_load_n.and_then(unloading),
            lifted_share: self.lifted as f64 / self.ticks as f64,
        }
    }
}
