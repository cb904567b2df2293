//! Recorded force-displacement loops of a bench test.

use std::ops::Range;

use super::CalibrationError;
use dashpot_recording::stretches::stretches;
use dashpot_testbench::smoothing::smooth;

/// Samples of a bench test.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    /// Name used in results.
    pub name: String,
    /// Times (s), strictly rising.
    pub times_s: Vec<f64>,
    /// Relative displacements of the two ends (m), positive in extension.
    pub displacements_m: Vec<f64>,
    /// Forces (N), positive in extension.
    pub forces_n: Vec<f64>,
}

/// Maximum number of ticks per test.
const MAX_TICKS: f64 = 4e6;

/// Minimum number of samples per test.
const MIN_SAMPLES: usize = 100;

/// Samples count once the force has reached this share of half its range in each direction. Until then, the force
/// depends on the unknown initial position within the clearance.
const CONTACT_SHARE: f64 = 0.05;

/// Time at the end of a recording in which samples do not count, because the smoothed motion is inaccurate there (s).
const END_S: f64 = 0.05;

impl Recorded {
    /// Builds a test from samples in memory; `name` is used in results.
    ///
    /// # Errors
    /// Returns an error for series of different lengths, values that are not finite, or times that do not rise.
    pub fn new(
        name: String,
        times_s: Vec<f64>,
        displacements_m: Vec<f64>,
        forces_n: Vec<f64>,
    ) -> Result<Self, CalibrationError> {
        let wrong = |reason| {
            Err(CalibrationError::Samples {
                test: name.clone(),
                reason,
            })
        };
        let counts = [&times_s, &displacements_m, &forces_n].map(Vec::len);
        if counts.iter().any(|count| *count != counts[0]) {
            let [times, displacements, forces] = counts;
            return wrong(format!(
                "{times} times, {displacements} displacements and {forces} forces, allowed: the same number of each"
            ));
        }
        let is_finite = |index: &usize| {
            let sample = [&times_s, &displacements_m, &forces_n].map(|values| values[*index]);
            sample.iter().all(|value| value.is_finite())
        };
        if let Some(index) = (0..counts[0]).find(|index| !is_finite(index)) {
            return wrong(format!("sample {index}: allowed: finite numbers"));
        }
        if let Some(before) = times_s.windows(2).position(|pair| pair[1] <= pair[0]) {
            let index = before + 1;
            return wrong(format!(
                "sample {index}: time {}, allowed: rising times",
                times_s[index]
            ));
        }
        Ok(Self {
            name,
            times_s,
            displacements_m,
            forces_n,
        })
    }

    /// Returns the stretches without a gap, and the number of further stretches that are too short for a test.
    fn tests(&self) -> (Vec<Range<usize>>, usize) {
        let (tests, short): (Vec<_>, Vec<_>) = stretches(&self.times_s)
            .into_iter()
            .partition(|stretch| stretch.len() >= MIN_SAMPLES);
        (tests, short.len())
    }

    /// Returns the number of stretches without a gap that have fewer than 100 samples and are left out.
    pub fn too_short(&self) -> usize {
        self.tests().1
    }
}

/// One bench test, ready to be compared with a model.
#[derive(Clone, Debug)]
pub struct LoopTest {
    /// Name used in results.
    pub name: String,
    /// Smoothed displacements at each tick (m).
    pub displacements_m: Vec<f64>,
    /// Times of the samples in ticks.
    pub(super) positions: Vec<f64>,
    /// Recorded forces at the samples (N).
    pub forces_n: Vec<f64>,
    /// Range of the samples that count.
    pub(super) counted: Range<usize>,
    /// Standard deviation of the displacement noise (m).
    pub displacement_noise_m: f64,
    /// Standard deviation of the force noise (N).
    pub force_noise_n: f64,
    /// Half the range of the displacement (m).
    pub amplitude_m: f64,
    /// Peak velocity (m/s).
    pub peak_velocity_m_per_s: f64,
    /// Peak of the smoothed force, as a magnitude (N).
    pub peak_force_n: f64,
    /// Half the range of the smoothed force (N).
    pub force_half_range_n: f64,
    /// Middle of the range of the recorded displacement (m); no force depends on it.
    pub displacement_offset_m: f64,
    /// Oil temperature (degC); `None` is that of the damper.
    pub temperature_c: Option<f64>,
}

/// The median counts as an estimate of zero force if the maximum and the minimum force differ from it by more than this
/// share of half the range.
const BALANCE_SHARE: f64 = 0.25;

/// Estimates what the sensor reads at zero force, from forces between `min` and `max` (N).
///
/// The estimate is the median, because a damper pulls and pushes for about the same time. If the forces about the
/// median are one-sided, the estimate is 0. It is used only to decide where a test begins to count.
fn estimated_zero_n(forces: &[f64], min: f64, max: f64) -> f64 {
    let mut sorted = forces.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let enough = BALANCE_SHARE * 0.5 * (max - min);
    if max - median > enough && median - min > enough {
        median
    } else {
        0.0
    }
}

/// Factors that multiply both signals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Factors {
    pub(super) displacement: f64,
    pub(super) force: f64,
}

impl Factors {
    pub(super) const ONE: Self = Self {
        displacement: 1.0,
        force: 1.0,
    };
}

/// Work of a recorded force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Work {
    /// Energy dissipated by the damper (J).
    pub(super) net_j: f64,
    /// Sum of the magnitudes of all increments (J).
    pub(super) magnitude_j: f64,
}

impl LoopTest {
    /// Splits a recording into tests at ticks of `step_s` (s), one per stretch without gaps.
    ///
    /// # Errors
    /// Returns an error for too few samples, too many ticks, or a force that acts in one direction only.
    pub fn from_recording(recorded: &Recorded, step_s: f64) -> Result<Vec<Self>, CalibrationError> {
        let (stretches, _) = recorded.tests();
        let count = stretches.len();
        let tests = stretches.into_iter().enumerate().map(|(index, stretch)| {
            let name = match count {
                1 => recorded.name.clone(),
                _ => format!("{} ({} of {count})", recorded.name, index + 1),
            };
            Self::from_stretch(name, recorded, stretch, step_s)
        });
        let tests: Vec<Self> = tests.collect::<Result<_, _>>()?;
        if tests.is_empty() {
            return Err(CalibrationError::TooShort {
                test: recorded.name.clone(),
                min: MIN_SAMPLES,
            });
        }
        Ok(tests)
    }

    fn from_stretch(
        name: String,
        recorded: &Recorded,
        stretch: Range<usize>,
        step_s: f64,
    ) -> Result<Self, CalibrationError> {
        let times_s = &recorded.times_s[stretch.clone()];
        let start_s = times_s[0];
        let positions: Vec<f64> = times_s
            .iter()
            .map(|time_s| (time_s - start_s) / step_s)
            .collect();
        let last = positions.last().copied().unwrap_or(0.0);
        if last > MAX_TICKS {
            return Err(CalibrationError::TooLong {
                test: name,
                duration_s: last * step_s,
                max_s: MAX_TICKS * step_s,
            });
        }
        let ticks = last as usize + 2;
        let displacement = smooth(
            &positions,
            &recorded.displacements_m[stretch.clone()],
            ticks,
        );
        let forces_n = recorded.forces_n[stretch].to_vec();
        let force = smooth(&positions, &forces_n, ticks);
        let x = displacement.values;
        let span = |values: &[f64]| {
            let min = values.iter().copied().fold(f64::INFINITY, f64::min);
            let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            (min, max)
        };
        let (shortest, longest) = span(&x);
        let (compression, extension) = span(&force.values);
        let peak_force_n = extension.max(-compression);
        let force_half_range_n = 0.5 * (extension - compression);
        let zero_n = estimated_zero_n(&force.values, compression, extension);
        let reaches = |sign: f64| {
            let reached =
                |force: &f64| sign * (force - zero_n) > CONTACT_SHARE * force_half_range_n;
            force.values.iter().position(reached)
        };
        let (Some(first), Some(second)) = (reaches(1.0), reaches(-1.0)) else {
            return Err(CalibrationError::OneSided { test: name });
        };
        let from = first.max(second) as f64;
        let from = positions.partition_point(|position| *position < from);
        let end = last - END_S / step_s;
        let to = positions.partition_point(|position| *position <= end);
        let velocities = x.windows(2).map(|pair| (pair[1] - pair[0]).abs() / step_s);
        Ok(Self {
            peak_velocity_m_per_s: velocities.fold(0.0, f64::max),
            amplitude_m: 0.5 * (longest - shortest),
            peak_force_n,
            force_half_range_n,
            displacement_offset_m: 0.5 * (shortest + longest),
            displacement_noise_m: displacement.noise,
            force_noise_n: force.noise,
            counted: from..to.max(from),
            temperature_c: None,
            displacements_m: x,
            positions,
            forces_n,
            name,
        })
    }

    /// Returns the same test with its signals multiplied by `factors`.
    pub(super) fn scaled(&self, factors: Factors) -> Self {
        let (of_x, of_force) = (factors.displacement, factors.force);
        let times =
            |values: &[f64], factor: f64| values.iter().map(|value| value * factor).collect();
        Self {
            displacements_m: times(&self.displacements_m, of_x),
            forces_n: times(&self.forces_n, of_force),
            displacement_noise_m: self.displacement_noise_m * of_x.abs(),
            force_noise_n: self.force_noise_n * of_force.abs(),
            amplitude_m: self.amplitude_m * of_x.abs(),
            peak_velocity_m_per_s: self.peak_velocity_m_per_s * of_x.abs(),
            peak_force_n: self.peak_force_n * of_force.abs(),
            force_half_range_n: self.force_half_range_n * of_force.abs(),
            displacement_offset_m: self.displacement_offset_m * of_x,
            ..self.clone()
        }
    }

    /// Returns the root mean square velocity (m/s) for ticks of `step_s` (s).
    pub(super) fn rms_velocity_m_per_s(&self, step_s: f64) -> f64 {
        let pairs = self.displacements_m.windows(2);
        let square: f64 = pairs.map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        (square / self.displacements_m.len() as f64).sqrt() / step_s
    }

    /// Returns the work that the recorded force takes from the motion.
    ///
    /// The mean force is subtracted, because a sensor offset does no work on a closed path.
    pub(super) fn work(&self) -> Work {
        let (x, forces) = (self.counted_displacements_m(), self.counted_forces_n());
        let mean = forces.iter().sum::<f64>() / forces.len().max(1) as f64;
        let moved = x.windows(2).map(|pair| pair[1] - pair[0]);
        let increments = forces
            .windows(2)
            .zip(moved)
            .map(|(pair, moved)| (0.5 * (pair[0] + pair[1]) - mean) * moved);
        increments.fold(Work::default(), |work, increment_j| Work {
            net_j: work.net_j + increment_j,
            magnitude_j: work.magnitude_j + increment_j.abs(),
        })
    }

    /// Returns the forces at the samples that count (N).
    pub fn counted_forces_n(&self) -> &[f64] {
        &self.forces_n[self.counted.clone()]
    }

    /// Returns the displacements at the samples that count (m).
    pub fn counted_displacements_m(&self) -> Vec<f64> {
        self.at_counted(&self.displacements_m, 0.0)
    }

    /// Returns the velocities at the samples that count (m/s) for ticks of `step_s` (s).
    pub fn counted_velocities_m_per_s(&self, step_s: f64) -> Vec<f64> {
        let pairs = self.displacements_m.windows(2);
        let velocities: Vec<f64> = pairs.map(|pair| (pair[1] - pair[0]) / step_s).collect();
        // Each velocity applies midway between two ticks.
        self.at_counted(&velocities, 0.5)
    }

    /// Returns the times of the samples that count (s), relative to the first sample of the test.
    pub fn counted_times_s(&self, step_s: f64) -> Vec<f64> {
        let counted = &self.positions[self.counted.clone()];
        counted.iter().map(|position| position * step_s).collect()
    }

    /// Interpolates values at ticks linearly, `delay` ticks before each sample that counts.
    pub(super) fn at_counted(&self, values: &[f64], delay: f64) -> Vec<f64> {
        let last = values.len() - 1;
        self.positions[self.counted.clone()]
            .iter()
            .map(|position| {
                let position = (position - delay).clamp(0.0, last as f64);
                let tick = (position as usize).min(last - 1);
                let fraction = position - tick as f64;
                values[tick] + fraction * (values[tick + 1] - values[tick])
            })
            .collect()
    }
}
