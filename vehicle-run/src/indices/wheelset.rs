//! Forces of a wheelset.

use dashpot_rail::contact::WheelsetForces;
use dashpot_rail::indices::prudhomme_limit_n;
use serde::Serialize;

use super::sums::{Spread, Windowed};
use super::wheel::{WheelIndices, WheelSums};
use crate::signals::load_n;

/// Forces of a wheelset.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WheelsetIndices {
    /// Name.
    pub wheelset: String,
    /// Root mean square of the lateral force of both rails on it, N.
    pub lateral_force_rms_n: f64,
    /// Greatest magnitude of its mean over 2 m, N.
    pub lateral_force_greatest_n: f64,
    /// Prud'homme's limit of that mean for the axle load at standstill, N.
    pub lateral_force_limit_n: Option<f64>,
    /// The greatest mean over the limit, dimensionless.
    pub lateral_force_over_limit: Option<f64>,
    /// Mean power that creep dissipates over the speed: the wear number, N.
    pub wear_number_n: f64,
    /// Root mean square of the wear number, N.
    pub wear_number_rms_n: f64,
    /// Greatest wear number, N.
    pub wear_number_greatest_n: f64,
    /// The left and the right wheel.
    pub wheels: Vec<WheelIndices>,
}

/// Sums of a wheelset.
#[derive(Debug, Clone)]
pub(super) struct WheelsetSums {
    name: String,
    axle_load_n: Option<f64>,
    lateral: Windowed,
    wear: Spread,
    wheels: [WheelSums; 2],
}

impl WheelsetSums {
    /// With windows of so many ticks and Nadal's limit.
    pub fn new(name: &str, axle_load_n: Option<f64>, window: usize, nadal: f64) -> Self {
        let wheel = WheelSums::new(window, nadal);
        Self {
            name: name.to_owned(),
            axle_load_n,
            lateral: Windowed::new(window),
            wear: Spread::default(),
            wheels: [wheel.clone(), wheel],
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
        let greatest_n = self.lateral.greatest_mean();
        let limit_n = self.axle_load_n.map(prudhomme_limit_n);
        let static_n = self.axle_load_n.map(|load_n| 0.5 * load_n);
        let wheels = self.wheels.iter().enumerate();
        let of_wheel = |(side, wheel): (_, &WheelSums)| wheel.indices(side, static_n, tick_m);
        WheelsetIndices {
            wheelset: self.name.clone(),
            lateral_force_rms_n: self.lateral.spread().rms(),
            lateral_force_greatest_n: greatest_n,
            lateral_force_limit_n: limit_n,
            lateral_force_over_limit: limit_n.map(|limit_n| greatest_n / limit_n),
            wear_number_n: self.wear.mean(),
            wear_number_rms_n: self.wear.rms(),
            wear_number_greatest_n: self.wear.greatest(),
            wheels: wheels.map(of_wheel).collect(),
        }
    }
}

/// Wear number of a wheelset: `Tx gx + Ty gy + M phi` of all patches, their creep forces times the creepages, N.
fn wear_number_n(contact: &WheelsetForces, speed_m_per_s: f64) -> f64 {
    let patches = contact
        .wheels
        .iter()
        .flat_map(|wheel| wheel.loaded_patches());
    patches.map(|patch| patch.dissipation_w).sum::<f64>() / speed_m_per_s
}
