//! Indices of a wheelset: lateral force and wear number.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::indices::{LowPass, prudhomme_limit_n};
use dashpot_rail::vehicle::Extremes;
use serde::Serialize;

use super::sums::{Range, Statistics, Windowed};
use super::wheel::{WheelIndices, WheelSums, WheelTick};
use super::{FILTER_HZ, Ticks};

/// Indices of a wheelset.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelsetIndices {
    /// Name of the wheelset.
    pub wheelset: String,
    /// Root mean square of the lateral force of both rails on the wheelset, N.
    pub lateral_force_rms_n: f64,
    /// Maximum magnitude of the mean over 2 m of the lateral force, filtered at 20 Hz, N.
    pub lateral_force_greatest_n: f64,
    /// Prud'homme's limit of the mean lateral force for the axle load at standstill, N.
    pub lateral_force_limit_n: Option<f64>,
    /// Maximum mean lateral force divided by the limit, dimensionless.
    pub lateral_force_over_limit: Option<f64>,
    /// Mean wear number, N: power dissipated by creep divided by the speed.
    pub wear_number_n: f64,
    /// Root mean square of the wear number, N.
    pub wear_number_rms_n: f64,
    /// Maximum wear number in any step inside a tick, N.
    pub wear_number_greatest_n: f64,
    /// Left and right wheel.
    pub wheels: Vec<WheelIndices>,
}

/// Accumulated forces of a wheelset.
#[derive(Debug, Clone)]
pub(super) struct WheelsetSums {
    name: String,
    axle_load_n: Option<f64>,
    lateral: Statistics,
    lateral_filter: LowPass,
    /// Averaged over 2 m.
    pub filtered_lateral: Windowed,
    wear: Statistics,
    greatest_wear_n: f64,
    pub wheels: [WheelSums; 2],
}

impl WheelsetSums {
    /// Starts with Nadal's limits of the left and the right wheel.
    pub fn new(name: &str, axle_load_n: Option<f64>, ticks: &Ticks, nadal: [f64; 2]) -> Self {
        Self {
            name: name.to_owned(),
            axle_load_n,
            lateral: Statistics::default(),
            lateral_filter: LowPass::new(FILTER_HZ, 1.0 / ticks.step_s),
            filtered_lateral: Windowed::new(ticks.longest_window()),
            wear: Statistics::default(),
            greatest_wear_n: 0.0,
            wheels: nadal.map(|limit| WheelSums::new(ticks, limit)),
        }
    }

    pub fn add(&mut self, contact: &WheelsetForces, extremes: &Extremes, ticks: &Ticks) {
        let lateral_n = contact.force_n[1];
        self.lateral.add(lateral_n);
        self.filtered_lateral
            .add(self.lateral_filter.next(lateral_n), ticks.window());
        let wear_number_n = wear_number_n(contact, ticks.speed_m_per_s);
        self.wear.add(wear_number_n);
        let greatest_n = extremes.greatest_dissipation_w / ticks.speed_m_per_s;
        self.greatest_wear_n = self.greatest_wear_n.max(greatest_n);
        let coefficients = contact.derailment_coefficients();
        for (side, (wheel, derailment)) in self.wheels.iter_mut().zip(coefficients).enumerate() {
            let wheel_tick = WheelTick {
                derailment,
                load_n: contact.wheels[side].load_n(),
                loads_n: Range {
                    min: extremes.least_loads_n[side],
                    max: extremes.greatest_loads_n[side],
                },
            };
            wheel.add(&wheel_tick, ticks);
        }
    }

    pub fn indices(&self, ticks: &Ticks) -> WheelsetIndices {
        let max_lateral_n = self.filtered_lateral.max_mean_magnitude();
        let limit_n = self.axle_load_n.map(prudhomme_limit_n);
        let static_n = self.axle_load_n.map(|load_n| 0.5 * load_n);
        let wheels = self.wheels.iter().enumerate();
        let wheel_indices = |(side, wheel): (_, &WheelSums)| wheel.indices(side, static_n, ticks);
        WheelsetIndices {
            wheelset: self.name.clone(),
            lateral_force_rms_n: self.lateral.rms(),
            lateral_force_greatest_n: max_lateral_n,
            lateral_force_limit_n: limit_n,
            lateral_force_over_limit: limit_n.map(|limit_n| max_lateral_n / limit_n),
            wear_number_n: self.wear.mean(),
            wear_number_rms_n: self.wear.rms(),
            wear_number_greatest_n: self.greatest_wear_n,
            wheels: wheels.map(wheel_indices).collect(),
        }
    }
}

/// Wear number of a wheelset, N: `Tx gx + Ty gy + M phi` summed over all patches, with the creep forces `Tx`, `Ty`, the
/// spin moment `M` and the creepages `gx`, `gy` and spin `phi`.
fn wear_number_n(contact: &WheelsetForces, speed_m_per_s: f64) -> f64 {
    contact.dissipation_w() / speed_m_per_s
}
