//! Indices of a steady motion with the uncertainty from the scatter between its cycles.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::SteadyMotion;
use super::motion::mean_of;
use crate::bench_sheet::index_value;
use crate::bench_test::Cycle;
use dashpot_files::harmonic::Harmonic;
use dashpot_files::sheet::Index;

/// Probability that an interval contains the value.
const CONFIDENCE: f64 = 0.95;

/// A value with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Estimate {
    /// Value, in the unit of the index's key.
    pub value: f64,
    /// Half of the 95 % interval, in the same unit.
    pub half_width: f64,
}

/// Relative uncertainty of the sensors that all cycles share, such as that of their calibration.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct SensorUncertainty {
    /// Half of the 95 % interval of the force's factor (1).
    pub force: f64,
    /// Half of the 95 % interval of the displacement's factor (1).
    pub displacement: f64,
}

impl SensorUncertainty {
    /// Adds this uncertainty to that of an index, as the root of the sum of squares.
    ///
    /// An index that is proportional to a signal has the relative uncertainty of the signal's factor. That the damper
    /// was moved a little faster or slower than measured is not included.
    pub fn widened(self, index: Index, estimate: Estimate) -> Estimate {
        let (by_force, by_displacement) = match index {
            Index::MaxExtensionForceN
            | Index::MaxCompressionForceN
            | Index::ExtensionForceAtPeakVelocityN
            | Index::CompressionForceAtPeakVelocityN => (1.0, 0.0),
            Index::EnergyPerCycleJ
            | Index::DampingCoefficientNSPerM
            | Index::DynamicStiffnessNPerM => (1.0, 1.0),
            Index::AsymmetryRate | Index::LossAngleDeg => (0.0, 0.0),
        };
        let relative = (by_force * self.force).hypot(by_displacement * self.displacement);
        Estimate {
            half_width: estimate.half_width.hypot(relative * estimate.value),
            ..estimate
        }
    }
}

impl SteadyMotion {
    /// Returns the indices of the mean loop, in the order of [`Index::ALL`]; `None` where undefined.
    ///
    /// The uncertainty is that of the jackknife: the scatter of the index among the mean loops that leave out one cycle
    /// each, times `n - 1`, as an interval of Student's t with `n - 1` degrees of freedom (Efron and Tibshirani, An
    /// Introduction to the Bootstrap, 1993, chapter 11). It includes noise and scatter of the damper, not errors that
    /// all cycles share, such as that of a sensor's calibration.
    pub fn indices(&self) -> [(Index, Option<Estimate>); Index::ALL.len()] {
        let count = self.loops.len();
        let all = values(&self.mean);
        let left_out = self.loops.iter().map(|cycle| values(&self.without(cycle)));
        let left_out: Vec<_> = left_out.collect();
        let quantile = StudentsT::new(0.0, 1.0, count as f64 - 1.0)
            .map_or(f64::INFINITY, |t| t.inverse_cdf(0.5 + 0.5 * CONFIDENCE));
        std::array::from_fn(|index| {
            let estimate = || {
                let value = all[index]?;
                let others: Option<Vec<f64>> =
                    left_out.iter().map(|values| values[index]).collect();
                let others = others?;
                let mean = others.iter().sum::<f64>() / count as f64;
                let squares: f64 = others.iter().map(|other| (other - mean).powi(2)).sum();
                let deviation = (squares * (count as f64 - 1.0) / count as f64).sqrt();
                Some(Estimate {
                    value,
                    half_width: quantile * deviation,
                })
            };
            (Index::ALL[index], estimate())
        })
    }

    /// Returns the mean loop without one of the cycles.
    fn without(&self, cycle: &Cycle) -> Cycle {
        let count = self.loops.len() as f64;
        let left = |mean: f64, value: f64| (count * mean - value) / (count - 1.0);
        let lefts = |means: &[f64], values: &[f64]| {
            let pairs = means.iter().zip(values);
            pairs.map(|(mean, value)| left(*mean, *value)).collect()
        };
        let mean = &self.mean;
        let step_s = left(mean.step_s, cycle.step_s);
        Cycle {
            motion: Harmonic {
                amplitude_m: left(mean.motion.amplitude_m, cycle.motion.amplitude_m),
                frequency_hz: 1.0 / (step_s * mean.forces_n.len() as f64),
            },
            displacements_m: lefts(&mean.displacements_m, &cycle.displacements_m),
            forces_n: lefts(&mean.forces_n, &cycle.forces_n),
            step_s,
            cycles: mean.cycles - 1,
        }
    }

    /// Returns the change of the force from the first to the last third of the cycles, as a share of the force: warming
    /// oil makes it negative.
    pub fn force_change(&self) -> f64 {
        let third = (self.loops.len() / 3).max(1);
        let half_range = |loops: &[Cycle]| {
            let indices = mean_of(loops).indices();
            indices.max_extension_force_n + indices.max_compression_force_n
        };
        let before = half_range(&self.loops[..third]);
        let after = half_range(&self.loops[self.loops.len() - third..]);
        if before > 0.0 {
            after / before - 1.0
        } else {
            0.0
        }
    }
}

fn values(cycle: &Cycle) -> [Option<f64>; Index::ALL.len()] {
    Index::ALL.map(|index| index_value(cycle, index))
}
