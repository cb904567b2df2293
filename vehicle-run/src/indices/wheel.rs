//! Forces of a wheel.

use dashpot_rail::indices::wheel_unloading;
use serde::Serialize;

use super::sums::{Longest, Windowed};
use crate::signals::SIDES;

/// Forces of a wheel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelIndices {
    /// Side.
    pub side: &'static str,
    /// Greatest magnitude of the mean of `Y/Q` over 2 m, dimensionless.
    pub derailment_greatest: f64,
    /// Root mean square of `Y/Q`, dimensionless.
    pub derailment_rms: f64,
    /// Greatest mean of `Y/Q` over 2 m towards climbing over Nadal's limit, dimensionless; 0 where it is never towards climbing.
    pub derailment_over_nadal: f64,
    /// Longest distance on which `Y/Q` is beyond Nadal's limit throughout, m.
    pub longest_over_nadal_m: f64,
    /// Least load, N.
    pub load_least_n: f64,
    /// Greatest load, N.
    pub load_greatest_n: f64,
    /// Load at standstill, half that of the axle, N.
    pub load_static_n: Option<f64>,
    /// Greatest unloading `(Q0 - Q)/Q0` from the load `Q0` at standstill, dimensionless: 1 is lifted.
    pub unloading_greatest: Option<f64>,
    /// Greatest unloading of the load's mean over 2 m, dimensionless.
    pub unloading_of_mean_greatest: Option<f64>,
    /// Part of the time in which the wheel is lifted, dimensionless.
    pub lifted_share: f64,
}

/// Sums of a wheel.
#[derive(Debug, Clone)]
pub(super) struct WheelSums {
    derailment: Windowed,
    load: Windowed,
    least_n: f64,
    ticks: u64,
    lifted: u64,
    nadal: f64,
    over_nadal: Longest,
}

impl WheelSums {
    /// With windows of so many ticks and Nadal's limit.
    pub fn new(window: usize, nadal: f64) -> Self {
        Self {
            derailment: Windowed::new(window),
            load: Windowed::new(window),
            least_n: f64::INFINITY,
            ticks: 0,
            lifted: 0,
            nadal,
            over_nadal: Longest::default(),
        }
    }

    /// Adds `Y/Q` and `Q`, N.
    pub fn add(&mut self, derailment: f64, load_n: f64) {
        self.ticks += 1;
        self.derailment.add(derailment);
        self.load.add(load_n);
        self.least_n = self.least_n.min(load_n);
        self.lifted += u64::from(load_n <= 0.0);
        self.over_nadal.add(derailment > self.nadal);
    }

    pub fn indices(&self, side: usize, static_n: Option<f64>, tick_m: f64) -> WheelIndices {
        let least_mean_n = self.load.means().map(|[least, _]| least);
        let climbing = self.derailment.means().map_or(0.0, |[_, most]| most);
        let unloading = |load_n| Some(wheel_unloading(static_n?, load_n));
        WheelIndices {
            side: SIDES[side],
            derailment_greatest: self.derailment.greatest_mean(),
            derailment_rms: self.derailment.spread().rms(),
            derailment_over_nadal: climbing.max(0.0) / self.nadal,
            longest_over_nadal_m: self.over_nadal.ticks() as f64 * tick_m,
            load_least_n: self.least_n,
            load_greatest_n: self.load.spread().greatest(),
            load_static_n: static_n,
            unloading_greatest: unloading(self.least_n),
            unloading_of_mean_greatest: least_mean_n.and_then(unloading),
            lifted_share: self.lifted as f64 / self.ticks as f64,
        }
    }
}
