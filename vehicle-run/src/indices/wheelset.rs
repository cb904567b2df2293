//! Indices of a wheelset: lateral force and wear number.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::indices::prudhomme_limit_n;
use serde::Serialize;

use super::sums::{Statistics, Windowed};
use super::wheel::{WheelIndices, WheelSums};
use crate::signals::load_n;

/// Indices of a wheelset.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelsetIndices {
    /// Name of the wheelset.
    pub wheelset: String,
    /// Root mean square of the lateral force of both rails on the wheelset, N.
    pub lateral_force_rms_n: f64,
    /// Maximum magnitude of the mean lateral force over 2 m, N.
    pub lateral_force_greatest_n: f64,
    /// Prud'homme's limit of the mean lateral force for the axle load at standstill, N.
    pub lateral_force_limit_n: Option<f64>,
    /// Maximum mean lateral force divided by the limit, dimensionless.
    pub lateral_force_over_limit: Option<f64>,
    /// Mean wear number, N: power dissipated by creep divided by the speed.
    pub wear_number_n: f64,
    /// Root mean square of the wear number, N.
    pub wear_number_rms_n: f64,
    /// Maximum wear number, N.
    pub wear_number_greatest_n: f64,
    /// Left and right wheel.
    pub wheels: Vec<WheelIndices>,
}

/// Accumulated forces of a wheelset.
#[derive(Debug, Clone)]
pub(super) struct WheelsetSums {
    name: String,
    axle_load_n: Option<f64>,
    lateral: Windowed,
    wear: Statistics,
    wheels: [WheelSums; 2],
}

impl WheelsetSums {
    /// Starts with windows of `window` ticks and Nadal's limits of the left and the right wheel.
    pub fn new(name: &str, axle_load_n: Option<f64>, window: usize, nadal: [f64; 2]) -> Self {
        Self {
            name: name.to_owned(),
            axle_load_n,
            lateral: Windowed::new(window),
            wear: Statistics::default(),
            wheels: nadal.map(|limit| WheelSums::new(window, limit)),
        }
    }

    pub fn add(&mut self, contact: &WheelsetForces, speed_m_per_s: f64) {
        self.lateral.add(contact.force_n[1]);
        self.wear.add(wear_number_n(contact, speed_m_per_s));
        let coefficients = contact.derailment_coefficients();
        for (side, (wheel, coefficient)) in self.wheels.iter_mut().zip(coefficients).enumerate() {
            wheel.add(coefficient, load_n(contact, side));
        }
    }

    pub fn indices(&self, tick_m: f64) -> WheelsetIndices {
        let max_lateral_n = self.lateral.max_mean_magnitude();
        let limit_n = self.axle_load_n.map(prudhomme_limit_n);
        let static_n = self.axle_load_n.map(|load_n| 0.5 * load_n);
        let wheels = self.wheels.iter().enumerate();
        let wheel_indices = |(side, wheel): (_, &WheelSums)| wheel.indices(side, static_n, tick_m);
        WheelsetIndices {
            wheelset: self.name.clone(),
            lateral_force_rms_n: self.lateral.statistics().rms(),
            lateral_force_greatest_n: max_lateral_n,
            lateral_force_limit_n: limit_n,
            lateral_force_over_limit: limit_n.map(|limit_n| max_lateral_n / limit_n),
            wear_number_n: self.wear.mean(),
            wear_number_rms_n: self.wear.rms(),
            wear_number_greatest_n: self.wear.max_magnitude(),
            wheels: wheels.map(wheel_indices).collect(),
        }
    }
}

/// Wear number of a wheelset, N: `Tx gx + Ty gy + M phi` summed over all patches, with the creep forces `Tx`, `Ty`, the
/// spin moment `M` and the creepages `gx`, `gy` and spin `phi`.
fn wear_number_n(contact: &WheelsetForces, speed_m_per_s: f64) -> f64 {
    let patches = contact
        .wheels
        .iter()
        .flat_map(|wheel| wheel.loaded_patches());
    patches.map(|patch| patch.dissipation_w).sum::<f64>() / speed_m_per_s
}
