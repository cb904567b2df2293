//! The actuator with its valve, its controller and the specimen.

use nalgebra::{SMatrix, SVector};

use super::RATE_HZ;
use crate::linear::LinearSystem;
use crate::sensor::Noise;

/// Mass (kg) and damping ratio (1) of the specimen.
pub(super) const SPECIMEN_KG: f64 = 29.13;
const SPECIMEN_DAMPING: f64 = 0.0097;
/// Gain of the measured displacement, of the valve and of the control-structure interaction.
const GAIN: f64 = 1.0261;
const VALVE: f64 = 2.1283e13;
const INTERACTION: f64 = 4.2297e6;
/// The force is a state in MN, so that all states have similar sizes.
const N_PER_MN: f64 = 1e6;

/// Parameters of the plant that differ from one to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plant {
    /// Damping coefficient of the valve (1/s).
    pub beta1_per_s: f64,
    /// Squared frequency of the valve (1/s^2).
    pub beta2_per_s2: f64,
    /// Pole of the actuator (1/s).
    pub a3_per_s: f64,
    /// Stiffness of the specimen (N/m).
    pub stiffness_n_per_m: f64,
}

impl Plant {
    /// The identified plant.
    pub const NOMINAL: Self = Self {
        beta1_per_s: 425.0,
        beta2_per_s2: 9.9976e4,
        a3_per_s: 3.3,
        stiffness_n_per_m: 1.19e6,
    };

    /// A plant whose parameters have the published standard deviations.
    pub fn perturbed(noise: &mut Noise) -> Self {
        let nominal = Self::NOMINAL;
        Self {
            beta1_per_s: nominal.beta1_per_s + 3.3 * noise.normal(),
            beta2_per_s2: nominal.beta2_per_s2 + 3.3e3 * noise.normal(),
            a3_per_s: nominal.a3_per_s + 1.3 * noise.normal(),
            stiffness_n_per_m: nominal.stiffness_n_per_m + 5e4 * noise.normal(),
        }
    }

    /// Damping of the specimen (N s/m).
    pub(super) fn damping_n_s_per_m(&self) -> f64 {
        2.0 * SPECIMEN_DAMPING * libm::sqrt(self.stiffness_n_per_m * SPECIMEN_KG)
    }

    /// Coefficients of the Taylor series of the inverse, from command to measured displacement: 1, s, s^2, s^3.
    ///
    /// ```
    /// use dashpot_hybrid::benchmark::Plant;
    ///
    /// let [a0, a1, ..] = Plant::NOMINAL.inverse();
    /// assert!((a1 / a0 - 0.0251).abs() < 1e-4); // 25 ms late at low frequency, as published
    /// ```
    pub fn inverse(&self) -> [f64; 4] {
        // 1/G = ((s^2 + beta1 s + beta2) ((s + a3) (m s^2 + c s + k) + interaction s) + valve)/(gain valve)
        let valve = [self.beta2_per_s2, self.beta1_per_s, 1.0];
        let (m, c, k) = (
            SPECIMEN_KG,
            self.damping_n_s_per_m(),
            self.stiffness_n_per_m,
        );
        let a3 = self.a3_per_s;
        let loaded = [a3 * k, k + a3 * c + INTERACTION, c + a3 * m, m];
        let coefficient = |power: usize| -> f64 {
            let products =
                (0..=power.min(2)).map(|of_valve| valve[of_valve] * loaded[power - of_valve]);
            products.sum::<f64>() / (GAIN * VALVE)
        };
        let mut series = [0, 1, 2, 3].map(coefficient);
        series[0] += 1.0 / GAIN;
        series
    }
}

/// A plant in motion.
#[derive(Clone, Debug)]
pub(super) struct MovingPlant {
    /// Valve (m and its rate), force (MN), displacement (m) and velocity of the specimen.
    system: LinearSystem<5, 1>,
}

impl MovingPlant {
    pub(super) fn new(plant: &Plant) -> Self {
        let valve = VALVE / N_PER_MN;
        let mass = SPECIMEN_KG / N_PER_MN;
        let a: SMatrix<f64, 5, 5> = SMatrix::from_row_slice(&[
            0.0,
            1.0,
            0.0,
            0.0,
            0.0,
            -plant.beta2_per_s2,
            -plant.beta1_per_s,
            0.0,
            -valve,
            0.0,
            1.0,
            0.0,
            -plant.a3_per_s,
            0.0,
            -INTERACTION / N_PER_MN,
            0.0,
            0.0,
            0.0,
            0.0,
            1.0,
            0.0,
            0.0,
            1.0 / mass,
            -plant.stiffness_n_per_m / SPECIMEN_KG,
            -plant.damping_n_s_per_m() / SPECIMEN_KG,
        ]);
        let b = SVector::from([0.0, valve, 0.0, 0.0, 0.0]);
        Self {
            system: LinearSystem::new(&a, &b, 1.0 / RATE_HZ),
        }
    }

    /// Displacement (m) and force (N) of the specimen.
    pub(super) fn output(&self) -> (f64, f64) {
        let state = &self.system.state;
        (GAIN * state[3], GAIN * N_PER_MN * state[2])
    }

    /// Takes a step with the command (m).
    pub(super) fn step(&mut self, command_m: f64) {
        self.system.step(&SVector::from([command_m]));
    }
}

#[cfg(test)]
mod tests {
    use super::{MovingPlant, Plant};
    use crate::benchmark::RATE_HZ;

    /// Delay and gain at 1, 5, 10 and 20 Hz, as published (`hybrid` benchmark, Silva and others 2020).
    #[test]
    fn delay_and_gain_are_those_of_the_identified_plant() {
        for (frequency_hz, delay_s, gain) in [
            (1.0, 0.025, 1.0),
            (5.0, 0.023, 0.85),
            (10.0, 0.019, 0.63),
            (20.0, 0.014, 0.41),
        ] {
            let mut plant = MovingPlant::new(&Plant::NOMINAL);
            let omega = std::f64::consts::TAU * frequency_hz;
            let (mut sine, mut cosine) = (0.0, 0.0);
            let whole = (4.0 * RATE_HZ) as u32;
            for tick in 0..2 * whole {
                let phase = omega * f64::from(tick) / RATE_HZ;
                if tick >= whole {
                    sine += 2.0 * plant.output().0 * phase.sin() / f64::from(whole);
                    cosine += 2.0 * plant.output().0 * phase.cos() / f64::from(whole);
                }
                plant.step(phase.sin());
            }
            let (found_gain, found_s) = (sine.hypot(cosine), -cosine.atan2(sine) / omega);
            assert!(
                (found_gain - gain).abs() < 0.01,
                "{frequency_hz} Hz: gain {found_gain}"
            );
            assert!(
                (found_s - delay_s).abs() < 0.6e-3,
                "{frequency_hz} Hz: {found_s} s"
            );
        }
    }
}
