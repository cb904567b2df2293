//! Steady harmonic cycles in the recording of a bench, and the indices of their mean loop with uncertainties.
//!
//! 1. A smoothing spline removes the noise of both signals ([`smooth`]).
//! 2. Each rise of the displacement through its middle begins a cycle; a sine is fitted to it.
//! 3. Successive cycles of equal amplitude and frequency form a motion.
//! 4. Cycles at its ends whose displacement or force differs from that of the others are left out: the rig starts or
//!    stops, or the oil has not settled.

mod cycles;
mod motion;
mod uncertainty;

use std::ops::Range;

use serde::Serialize;

use crate::bench_test::Cycle;
use crate::smoothing::smooth;
use cycles::Signals;
use dashpot_recording::stretches::{median_interval, stretches};
pub use uncertainty::{Estimate, SensorUncertainty};

/// Minimum number of cycles of a steady motion.
pub const MIN_CYCLES: usize = 3;

/// Minimum number of samples per cycle.
pub const MIN_SAMPLES_PER_CYCLE: f64 = 20.0;

/// A cycle counts as harmonic if the rms of its displacement about a sine is at most this share of the sine's rms. A
/// triangular motion has 0.12.
pub const MAX_DISTORTION: f64 = 0.1;

/// Maximum number of ticks of the smoothed signals.
const MAX_TICKS: f64 = 4e6;

/// Ticks per cycle that make the error of linear interpolation less than 2e-5 of the amplitude.
const TICKS_PER_CYCLE: f64 = 400.0;

/// Samples of a bench test. The three slices have the same length, the times rise, and all values are finite.
#[derive(Clone, Copy, Debug)]
pub struct Samples<'a> {
    /// Times (s).
    pub times_s: &'a [f64],
    /// Displacements (m), positive in extension.
    pub displacements_m: &'a [f64],
    /// Forces (N), positive in extension.
    pub forces_n: &'a [f64],
}

/// A steady harmonic motion in a recording.
#[derive(Clone, Debug)]
pub struct SteadyMotion {
    /// Time at which the first cycle begins (s).
    pub start_s: f64,
    /// Time at which the last cycle ends (s).
    pub end_s: f64,
    /// Mean of all cycles; its motion is the measured one.
    pub mean: Cycle,
    /// The cycles.
    pub loops: Vec<Cycle>,
    /// Middle of the displacement (m).
    pub offset_m: f64,
    /// Root mean square of the displacement about a sine, as a share of the sine's (1).
    pub distortion: f64,
    /// Cycles of the same motion that are left out, because their displacement or force differs.
    pub unsteady_cycles: usize,
}

/// Cycles that belong to no steady motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct UnusedCycles {
    /// Time at which they begin (s).
    pub start_s: f64,
    /// Number of cycles.
    pub cycles: usize,
    /// Mean amplitude (m).
    pub amplitude_m: f64,
    /// Mean frequency (Hz).
    pub frequency_hz: f64,
    /// Why they are not used.
    pub reason: Unused,
}

/// Reason why cycles are not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Unused {
    /// The motion is not harmonic.
    NotHarmonic,
    /// There are fewer than [`MIN_CYCLES`] equal cycles.
    FewCycles,
    /// There are fewer than [`MIN_SAMPLES_PER_CYCLE`] samples per cycle.
    FewSamples,
}

/// What a recording contains.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Steady motions, in the order of time.
    pub motions: Vec<SteadyMotion>,
    /// All other cycles, in the order of time.
    pub unused: Vec<UnusedCycles>,
}

/// Finds the steady harmonic motions in a recording. Gaps separate motions.
///
/// ```
/// use dashpot_testbench::steady::{Samples, find};
/// let times_s: Vec<f64> = (0..5000).map(|tick| f64::from(tick) * 1e-3).collect();
/// let phase = |time_s: &f64| std::f64::consts::TAU * 2.0 * time_s;
/// let displacements_m: Vec<f64> = times_s.iter().map(|time_s| 0.01 * phase(time_s).sin()).collect();
/// let forces_n: Vec<f64> = times_s.iter().map(|time_s| 500.0 * phase(time_s).cos()).collect();
/// let found = find(Samples { times_s: &times_s, displacements_m: &displacements_m, forces_n: &forces_n });
/// let motion = &found.motions[0];
/// assert!((motion.mean.motion.amplitude_m - 0.01).abs() < 1e-6);
/// assert!((motion.mean.indices().max_extension_force_n - 500.0).abs() < 0.1);
/// ```
pub fn find(samples: Samples<'_>) -> Found {
    let mut found = Found::default();
    for stretch in stretches(samples.times_s) {
        find_in(samples, stretch, &mut found);
    }
    found
}

fn find_in(samples: Samples<'_>, stretch: Range<usize>, found: &mut Found) {
    let times_s = &samples.times_s[stretch.clone()];
    let Some(interval_s) = median_interval(times_s) else {
        return;
    };
    let [displacements, forces] =
        [samples.displacements_m, samples.forces_n].map(|values| &values[stretch.clone()]);
    let duration_s = times_s[times_s.len() - 1] - times_s[0];
    let coarse_s = interval_s.max(duration_s / MAX_TICKS);
    let smoothed = |values: &[f64], tick_s: f64| {
        let position = |time_s: &f64| (time_s - times_s[0]) / tick_s;
        let positions: Vec<f64> = times_s.iter().map(position).collect();
        smooth(&positions, values, (duration_s / tick_s) as usize + 2)
    };
    let shortest_s = cycles::shortest_s(&smoothed(displacements, coarse_s), coarse_s);
    let fine_s = shortest_s.map_or(coarse_s, |period_s| period_s / TICKS_PER_CYCLE);
    let tick_s = coarse_s.min(fine_s).max(duration_s / MAX_TICKS);
    let signals = Signals {
        start_s: times_s[0],
        tick_s,
        sample_s: interval_s,
        displacement: smoothed(displacements, tick_s),
        force: smoothed(forces, tick_s),
    };
    motion::sort(&signals, &signals.cycles(), found);
}

impl Found {
    /// True if the recording has no cycle at all.
    pub fn is_empty(&self) -> bool {
        self.motions.is_empty() && self.unused.is_empty()
    }
}
