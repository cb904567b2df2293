//! Tests that were not fitted, predicted with the calibrated damper, and where a model differs systematically.

use serde::Serialize;

use super::loops::LoopTest;
use super::misfit::force_rms_n;
use super::model::Model;
use super::residual::correlation_samples;
use super::{Calibrated, Calibration, CalibrationError};

/// Number of velocity intervals over which the difference is averaged.
const BINS: usize = 16;

/// A difference counts as systematic if its mean exceeds this many standard errors.
const SYSTEMATIC_DEVIATIONS: f64 = 3.0;

/// A test predicted with the calibrated damper.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Predicted {
    /// Name of the test.
    pub test: String,
    /// Samples that count.
    pub samples: usize,
    /// Root mean square of the force about its mean (N).
    pub force_rms_n: f64,
    /// Standard deviation of the force noise (N).
    pub force_noise_n: f64,
    /// Mean of measured minus predicted force (N), left out of the following.
    pub mean_n: f64,
    /// Root mean square of measured minus predicted force (N).
    pub error_n: f64,
    /// The same beyond the noise, as a share of the force.
    pub error_share: f64,
    /// Greatest systematic difference over the velocity; `None` if there is none.
    pub systematic: Option<Systematic>,
    /// Mean difference in intervals of the velocity.
    pub over_velocity: Vec<Systematic>,
}

/// Mean difference at a velocity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Systematic {
    /// Velocity (m/s), positive in extension.
    pub velocity_m_per_s: f64,
    /// Mean of measured minus predicted force (N).
    pub difference_n: f64,
    /// Its standard error (N).
    pub standard_error_n: f64,
}

impl Calibration {
    /// Predicts tests that were not fitted. Parameters of single tests keep the damper's values.
    ///
    /// # Errors
    /// The damper cannot be built.
    pub fn predicted(
        &self,
        found: &Calibrated,
        tests: Vec<LoopTest>,
    ) -> Result<Vec<Predicted>, CalibrationError> {
        let common = self.varied.iter().zip(&found.values);
        let common = common.filter(|(varied, _)| varied.test().is_none());
        let (varied, coordinates) = common
            .map(|(varied, value)| (varied.clone(), varied.coordinate(*value)))
            .unzip::<_, _, Vec<_>, Vec<_>>();
        let model = Model {
            damper: self.damper.clone(),
            varied,
            rig: self.rig,
            scatter_n: tests.iter().map(|_| 1.0).collect(),
            loops: tests,
            indices: Vec::new(),
            step_s: self.step_s,
            is_cancelled: &|| false,
        };
        let forces = model.forces_n(&coordinates)?;
        let tests = model.loops.iter().zip(&forces);
        Ok(tests
            .map(|(test, forces)| Predicted::new(test, forces, self.step_s))
            .collect())
    }
}

impl Predicted {
    /// Compares a test with the forces of a model at its samples.
    pub fn new(test: &LoopTest, forces_n: &[f64], step_s: f64) -> Self {
        let measured = test.counted_forces_n();
        let count = measured.len().max(1) as f64;
        let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / count;
        let pairs = || measured.iter().zip(forces_n);
        let force_rms_n = force_rms_n(test);
        let mean_n = mean(&mut pairs().map(|(force, model)| force - model));
        let residuals: Vec<f64> = pairs()
            .map(|(force, model)| force - model - mean_n)
            .collect();
        let error_n = mean(&mut residuals.iter().map(|residual| residual * residual)).sqrt();
        let beyond = (error_n.powi(2) - test.force_noise_n.powi(2))
            .max(0.0)
            .sqrt();
        let over_velocity = over_velocity(&residuals, &test.counted_velocities_m_per_s(step_s));
        let systematic = over_velocity.iter().copied();
        let systematic = systematic
            .filter(|bin| bin.difference_n.abs() > SYSTEMATIC_DEVIATIONS * bin.standard_error_n)
            .max_by(|a, b| a.difference_n.abs().total_cmp(&b.difference_n.abs()));
        Self {
            test: test.name.clone(),
            samples: measured.len(),
            force_rms_n,
            force_noise_n: test.force_noise_n,
            mean_n,
            error_n,
            error_share: beyond / force_rms_n.max(f64::MIN_POSITIVE),
            systematic,
            over_velocity,
        }
    }
}

/// Averages residuals in intervals of the velocity. Samples closer together than the correlation length within an
/// interval count as one.
fn over_velocity(residuals: &[f64], velocities_m_per_s: &[f64]) -> Vec<Systematic> {
    let peak = velocities_m_per_s
        .iter()
        .fold(0.0, |peak: f64, v| peak.max(v.abs()));
    if peak <= 0.0 {
        return Vec::new();
    }
    let mut bins = vec![Vec::new(); BINS];
    for (residual, velocity) in residuals.iter().zip(velocities_m_per_s) {
        let share = 0.5 * (velocity / peak + 1.0);
        bins[((share * BINS as f64) as usize).min(BINS - 1)].push(*residual);
    }
    let width = 2.0 * peak / BINS as f64;
    let filled = bins.iter().enumerate().filter(|(_, bin)| bin.len() > 1);
    let averaged = filled.map(|(number, bin)| {
        let count = bin.len() as f64;
        let mean = bin.iter().sum::<f64>() / count;
        let about: Vec<f64> = bin.iter().map(|residual| residual - mean).collect();
        let square = about
            .iter()
            .map(|residual| residual * residual)
            .sum::<f64>()
            / count;
        let independent = (count / correlation_samples(&about)).max(1.0);
        Systematic {
            velocity_m_per_s: -peak + (number as f64 + 0.5) * width,
            difference_n: mean,
            standard_error_n: (square / independent).sqrt(),
        }
    });
    averaged.collect()
}
