//! Residual of a model, with the rig's offset and delay fitted to it.

use super::CauseKind;
use crate::loops::LoopTest;

/// Gauss-Newton steps for offset and delay, which enter almost linearly.
const STEPS: usize = 3;

/// Prior of the rig: standard deviations of offset (N) and delay (s).
#[derive(Clone, Copy, Debug)]
pub(super) struct RigPrior {
    pub(super) offset_n: f64,
    pub(super) delay_s: f64,
}

/// A fitted model.
#[derive(Clone, Debug)]
pub(super) struct Fitted {
    pub(super) kind: CauseKind,
    /// Size of the cause.
    pub(super) value: f64,
    /// True if the cause is too small to count as a change.
    pub(super) is_small: bool,
    /// Number of parameters beside those of the rig.
    pub(super) parameters: u8,
    /// Forces minus those of the model at the samples that count (N).
    pub(super) residuals: Vec<f64>,
    /// Sum of their squares.
    pub(super) square: f64,
    /// Squared deviations of offset and delay from zero, in standard deviations.
    pub(super) penalty: f64,
    pub(super) offset_n: f64,
    pub(super) delay_s: f64,
}

impl Fitted {
    /// Compares forces at ticks with those of the tests.
    pub(super) fn new(
        kind: CauseKind,
        tests: &[LoopTest],
        forces: &[Vec<f64>],
        prior: RigPrior,
        step_s: f64,
    ) -> Self {
        let noise = tests
            .iter()
            .map(|test| test.force_noise_n)
            .fold(1e-3, f64::max);
        let (mut offset_n, mut delay_s) = (0.0, 0.0);
        let mut residuals = Vec::new();
        for _ in 0..STEPS {
            // Normal equations of the change of offset and delay: F - F_m(t - delay) - offset.
            let weights = [
                (noise / prior.offset_n).powi(2),
                (noise / prior.delay_s).powi(2),
            ];
            let mut matrix = [[weights[0], 0.0], [0.0, weights[1]]];
            let mut right = [-weights[0] * offset_n, -weights[1] * delay_s];
            residuals.clear();
            for (test, forces) in tests.iter().zip(forces) {
                let slopes: Vec<f64> = forces
                    .windows(2)
                    .map(|pair| -(pair[1] - pair[0]) / step_s)
                    .collect();
                let model = test.at_counted(forces, delay_s / step_s);
                let slopes = test.at_counted(&slopes, delay_s / step_s + 0.5);
                for ((measured, model), slope) in
                    test.counted_forces_n().iter().zip(model).zip(slopes)
                {
                    let residual = measured - model - offset_n;
                    residuals.push(residual);
                    matrix[0][0] += 1.0;
                    matrix[0][1] += slope;
                    matrix[1][1] += slope * slope;
                    right[0] += residual;
                    right[1] += slope * residual;
                }
            }
            matrix[1][0] = matrix[0][1];
            let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
            if determinant.is_nan() || determinant <= 0.0 {
                break;
            }
            offset_n += (right[0] * matrix[1][1] - right[1] * matrix[0][1]) / determinant;
            delay_s += (right[1] * matrix[0][0] - right[0] * matrix[1][0]) / determinant;
        }
        Self {
            kind,
            value: 0.0,
            is_small: false,
            parameters: 0,
            square: residuals.iter().map(|residual| residual * residual).sum(),
            penalty: (offset_n / prior.offset_n).powi(2) + (delay_s / prior.delay_s).powi(2),
            residuals,
            offset_n,
            delay_s,
        }
    }
}
