//! Cycles of a smoothed displacement.

use std::f64::consts::TAU;

use super::{MAX_DISTORTION, MIN_SAMPLES_PER_CYCLE, Unused};
use crate::smoothing::Smooth;

/// Samples to which the sine of a cycle is fitted.
const FITTED_SAMPLES: u32 = 128;

/// A turn of the displacement counts if it exceeds this many standard deviations of the noise.
const TURN_IN_DEVIATIONS: f64 = 6.0;

/// A turn of the displacement also has to exceed this share of its range.
const TURN_SHARE: f64 = 1e-4;

/// Smoothed signals of a stretch without gaps.
pub(super) struct Signals {
    /// Time of the first tick (s).
    pub(super) start_s: f64,
    /// Interval between ticks (s).
    pub(super) tick_s: f64,
    /// Interval between samples (s).
    pub(super) sample_s: f64,
    pub(super) displacement: Smooth,
    pub(super) force: Smooth,
}

/// A cycle from one rise of the fitted sine through its middle to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct FittedCycle {
    /// Start in ticks.
    pub(super) start: f64,
    /// Period in ticks.
    pub(super) period: f64,
    pub(super) amplitude_m: f64,
    pub(super) offset_m: f64,
    /// Root mean square about the sine, as a share of the sine's.
    pub(super) distortion: f64,
}

/// Interpolates `values` at `position` (ticks).
pub(super) fn at(values: &[f64], position: f64) -> f64 {
    let last = values.len() - 1;
    let position = position.clamp(0.0, last as f64);
    let tick = (position as usize).min(last.saturating_sub(1));
    let next = values[(tick + 1).min(last)];
    values[tick] + (position - tick as f64) * (next - values[tick])
}

/// Returns the shortest period of the displacement (s).
pub(super) fn shortest_s(displacement: &Smooth, tick_s: f64) -> Option<f64> {
    let rises = rises(displacement);
    let periods = rises.windows(2).map(|pair| pair[1] - pair[0]);
    periods.min_by(f64::total_cmp).map(|ticks| ticks * tick_s)
}

/// Returns where the displacement rises through the middle between a minimum and the next maximum (ticks).
fn rises(displacement: &Smooth) -> Vec<f64> {
    let x = &displacement.values;
    let (min, max) = x
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), x| {
            (min.min(*x), max.max(*x))
        });
    let threshold = (TURN_IN_DEVIATIONS * displacement.noise).max(TURN_SHARE * (max - min));
    let turns = turns(x, threshold);
    let rising = turns.windows(2).filter(|pair| x[pair[1]] > x[pair[0]]);
    let crossing = |pair: &[usize]| {
        let middle = 0.5 * (x[pair[0]] + x[pair[1]]);
        let after = (pair[0]..=pair[1]).find(|tick| x[*tick] >= middle)?;
        let before = after.checked_sub(1)?;
        Some(before as f64 + (middle - x[before]) / (x[after] - x[before]))
    };
    rising.filter_map(crossing).collect()
}

/// Returns the ticks of minima and maxima in turn, each at least `threshold` away from the one before.
fn turns(x: &[f64], threshold: f64) -> Vec<usize> {
    let (mut low, mut high) = (0, 0);
    let mut turns = Vec::new();
    // Towards a maximum, towards a minimum, or not known yet.
    let mut is_rising: Option<bool> = None;
    for tick in 1..x.len() {
        if x[tick] > x[high] {
            high = tick;
        }
        if x[tick] < x[low] {
            low = tick;
        }
        if is_rising != Some(false) && x[high] - x[tick] > threshold {
            turns.push(high);
            (is_rising, low) = (Some(false), tick);
        } else if is_rising != Some(true) && x[tick] - x[low] > threshold {
            turns.push(low);
            (is_rising, high) = (Some(true), tick);
        }
    }
    turns.extend(is_rising.map(|is_rising| if is_rising { high } else { low }));
    turns
}

impl Signals {
    /// Returns all cycles, in the order of time.
    pub(super) fn cycles(&self) -> Vec<FittedCycle> {
        let rises = rises(&self.displacement);
        rises
            .windows(2)
            .map(|pair| self.fit(pair[0], pair[1] - pair[0]))
            .collect()
    }

    /// Fits a sine with this period to the displacement from `from` (ticks) on.
    pub(super) fn fit(&self, from: f64, period: f64) -> FittedCycle {
        let count = f64::from(FITTED_SAMPLES);
        let samples: Vec<(f64, f64)> = (0..FITTED_SAMPLES)
            .map(|sample| {
                let share = f64::from(sample) / count;
                let x = at(&self.displacement.values, from + share * period);
                (TAU * share, x)
            })
            .collect();
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            samples.iter().map(|(angle, x)| of(*angle, *x)).sum::<f64>() / count
        };
        let offset_m = mean(&|_, x| x);
        let sine = 2.0 * mean(&|angle, x| x * angle.sin());
        let cosine = 2.0 * mean(&|angle, x| x * angle.cos());
        let amplitude_m = sine.hypot(cosine);
        let fitted = |angle: f64| offset_m + sine * angle.sin() + cosine * angle.cos();
        let rms = mean(&|angle, x| (x - fitted(angle)).powi(2)).sqrt();
        FittedCycle {
            start: from - cosine.atan2(sine) / TAU * period,
            period,
            amplitude_m,
            offset_m,
            distortion: rms / (amplitude_m * std::f64::consts::FRAC_1_SQRT_2),
        }
    }

    /// Returns why a cycle cannot be used, if so.
    pub(super) fn problem(&self, cycle: &FittedCycle) -> Option<Unused> {
        // NaN, from an amplitude of zero, is not harmonic either.
        if cycle.distortion.is_nan() || cycle.distortion > MAX_DISTORTION {
            Some(Unused::NotHarmonic)
        } else if cycle.period * self.tick_s < MIN_SAMPLES_PER_CYCLE * self.sample_s * (1.0 - 1e-6)
        {
            Some(Unused::FewSamples)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::turns;

    #[test]
    fn turns_below_the_threshold_are_noise() {
        let x = [0.0, 1.0, 0.9, 1.2, 0.0, 0.1, -0.1, 1.0];
        assert_eq!(turns(&x, 0.3), [0, 3, 6, 7]);
        assert_eq!(turns(&x, 0.05), [0, 1, 2, 3, 4, 5, 6, 7]);
        assert!(turns(&[0.0; 4], 0.1).is_empty());
    }
}
