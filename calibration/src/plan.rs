//! Which further test would narrow which parameter most.

use std::f64::consts::TAU;

use dashpot_files::harmonic::Harmonic;
use nalgebra::DMatrix;
use serde::Serialize;

use super::loops::LoopTest;
use super::model::Model;
use super::{Calibrated, Calibration, CalibrationError};

/// Cycles of a planned test that count; one more comes before them.
const CYCLES: f64 = 5.0;

/// A harmonic test that may be done.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedTest {
    /// Name.
    pub name: String,
    /// Motion.
    pub motion: Harmonic,
    /// Oil temperature (degC); `None` is that of the damper.
    pub temperature_c: Option<f64>,
}

impl From<dashpot_files::sheet::Test> for PlannedTest {
    fn from(test: dashpot_files::sheet::Test) -> Self {
        Self {
            name: test.name,
            motion: test.motion,
            temperature_c: test.temperature_c,
        }
    }
}

/// How much a test would narrow the parameters.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Promise {
    /// Name of the test.
    pub test: String,
    /// For each parameter its standard deviation with this test, divided by that without it.
    pub shares: Vec<(String, f64)>,
}

impl Calibration {
    /// Computes how much each of `tests` would narrow the parameters, five cycles of each, by linear theory. The
    /// scatter of a test is taken as the same share of the force as in the recordings of this calibration.
    ///
    /// # Errors
    /// There are no recordings, or the damper cannot be built.
    pub fn promises(
        &self,
        found: &Calibrated,
        tests: &[PlannedTest],
    ) -> Result<Vec<Promise>, CalibrationError> {
        let Some(scatter_share) = self.scatter_share(found) else {
            return Err(CalibrationError::Nothing("recording"));
        };
        let coordinates: Vec<f64> = self
            .varied
            .iter()
            .zip(&found.values)
            .map(|(varied, value)| varied.coordinate(*value))
            .collect();
        let before = self.covariance(found);
        let Some(information) = before.clone().try_inverse() else {
            return Err(CalibrationError::NoFit(
                "the parameters depend on each other too closely to plan further tests".into(),
            ));
        };
        let all: Vec<usize> = (0..self.varied.len()).collect();
        let promise = |test: &PlannedTest| {
            let mut model = Model {
                damper: self.damper.clone(),
                varied: self.varied.clone(),
                rig: self.rig,
                loops: vec![test.as_loop(self.step_s)],
                indices: Vec::new(),
                step_s: self.step_s,
                scatter_n: vec![1.0],
                is_cancelled: &|| false,
            };
            let forces = model.forces_n(&coordinates)?.concat();
            let square = forces.iter().map(|force| force * force).sum::<f64>();
            let rms = (square / forces.len().max(1) as f64).sqrt();
            model.scatter_n = vec![(scatter_share * rms).max(f64::MIN_POSITIVE)];
            let slopes = model.slopes(&coordinates, &all)?;
            let after = (&information + slopes.transpose() * slopes).try_inverse();
            let share = |parameter: usize| {
                let after = after
                    .as_ref()
                    .map_or(f64::NAN, |after| after[(parameter, parameter)]);
                (after / before[(parameter, parameter)]).sqrt()
            };
            let named = self.varied.iter().zip(&all);
            Ok(Promise {
                test: test.name.clone(),
                shares: named
                    .map(|(varied, parameter)| (varied.key.clone(), share(*parameter)))
                    .collect(),
            })
        };
        tests.iter().map(promise).collect()
    }

    /// Returns the scatter of the fitted loops as a share of the force, with correlated samples counted as one.
    fn scatter_share(&self, found: &Calibrated) -> Option<f64> {
        let shares = self.loops.iter().zip(&found.loops).map(|(test, fit)| {
            fit.missed_after_n * fit.correlation_samples.sqrt() / test.force_half_range_n
        });
        // A sine has an rms of 0.7 of half its range.
        let count = self.loops.len();
        (count > 0).then(|| shares.sum::<f64>() / count as f64 * std::f64::consts::SQRT_2)
    }

    /// Returns the covariance of the coordinates, by linear theory.
    fn covariance(&self, found: &Calibrated) -> DMatrix<f64> {
        let deviations: Vec<f64> = self
            .varied
            .iter()
            .zip(&found.values)
            .zip(&found.determination.parameters)
            .map(|((varied, value), determined)| {
                determined.standard_deviation / varied.slope(*value)
            })
            .collect();
        let correlation = &found.determination.correlation;
        let count = deviations.len();
        DMatrix::from_fn(count, count, |row, column| {
            // The matrix may come without its diagonal of ones.
            let correlation = if row == column {
                1.0
            } else {
                correlation[row][column]
            };
            deviations[row] * deviations[column] * correlation
        })
    }
}

impl PlannedTest {
    fn as_loop(&self, step_s: f64) -> LoopTest {
        let Harmonic {
            amplitude_m,
            frequency_hz,
        } = self.motion;
        let period = 1.0 / frequency_hz / step_s;
        let ticks = (period * (CYCLES + 1.0)).ceil().clamp(2.0, 4e6) as usize;
        let at = |tick: usize| amplitude_m * (TAU * tick as f64 / period).sin();
        LoopTest {
            name: self.name.clone(),
            displacements_m: (0..=ticks).map(at).collect(),
            positions: (0..ticks).map(|tick| tick as f64).collect(),
            forces_n: vec![0.0; ticks],
            counted: (period as usize).min(ticks)..ticks,
            displacement_noise_m: 0.0,
            force_noise_n: 0.0,
            amplitude_m,
            peak_velocity_m_per_s: self.motion.peak_velocity_m_per_s(),
            peak_force_n: 0.0,
            force_half_range_n: 0.0,
            displacement_offset_m: 0.0,
            temperature_c: self.temperature_c,
        }
    }
}
