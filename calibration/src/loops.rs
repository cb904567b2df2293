//! Recorded force-displacement loops of a bench test.

use std::ops::Range;

use super::CalibrationError;
use dashpot_recording::stretches::stretches;
use dashpot_testbench::smoothing::smooth;

/// Samples of a bench test.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
    /// Name in results.
    pub name: String,
    /// Times (s), rising.
    pub times_s: Vec<f64>,
    /// Displacements of the seats (m), positive in extension.
    pub displacements_m: Vec<f64>,
    /// Forces (N), positive in extension.
    pub forces_n: Vec<f64>,
}

/// Ticks of one test at most.
const MOST_TICKS: f64 = 4e6;

/// Samples that tell something, at least.
const FEWEST_SAMPLES: usize = 100;

/// Share of its peak that the force must have had in both directions before it counts: until then, where in its clearance the damper began
/// decides.
const CONTACT: f64 = 0.05;

/// Time before the end of a recording in which a smoothed motion is not known well enough (s).
const END_S: f64 = 0.05;

impl Recorded {
    /// Samples that are in memory, called `name` in results.
    ///
    /// # Errors
    /// As many times as displacements and forces are allowed, finite numbers, and times that rise.
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
                "{times} times, {displacements} displacements and {forces} forces, allowed: as many of each"
            ));
        }
        let is_finite = |place: &usize| {
            let sample = [&times_s, &displacements_m, &forces_n].map(|values| values[*place]);
            sample.iter().all(|value| value.is_finite())
        };
        if let Some(place) = (0..counts[0]).find(|place| !is_finite(place)) {
            return wrong(format!("sample {place}: allowed: finite numbers"));
        }
        if let Some(place) = times_s.windows(2).position(|pair| pair[1] <= pair[0]) {
            let place = place + 1;
            return wrong(format!(
                "sample {place}: time {}, allowed: times that rise",
                times_s[place]
            ));
        }
        Ok(Self {
            name,
            times_s,
            displacements_m,
            forces_n,
        })
    }

    /// The stretches without a gap, and how many more there are that are too short to be a test.
    fn tests(&self) -> (Vec<Range<usize>>, usize) {
        let (tests, short): (Vec<_>, Vec<_>) = stretches(&self.times_s)
            .into_iter()
            .partition(|stretch| stretch.len() >= FEWEST_SAMPLES);
        (tests, short.len())
    }

    /// How many stretches without a gap are no test, for they have less than 100 samples.
    pub fn too_short(&self) -> usize {
        self.tests().1
    }
}

/// One bench test, ready to be compared with a model.
#[derive(Clone, Debug)]
pub struct LoopTest {
    /// Name in results.
    pub name: String,
    /// Displacements at ticks of the step (m), without the noise of their recording.
    pub displacements_m: Vec<f64>,
    /// Times of the samples, in ticks.
    pub(super) positions: Vec<f64>,
    /// Forces of the samples (N).
    pub forces_n: Vec<f64>,
    /// The samples that count.
    pub(super) counted: Range<usize>,
    /// Noise of the displacement and of the force, standard deviation (m, N).
    pub displacement_noise_m: f64,
    /// As above.
    pub force_noise_n: f64,
    /// Half of the way from the least to the greatest displacement (m).
    pub amplitude_m: f64,
    /// Largest velocity (m/s).
    pub peak_velocity_m_per_s: f64,
    /// Largest force, without noise (N).
    pub peak_force_n: f64,
    /// Half of the way from the least to the greatest force, without noise (N).
    pub force_half_range_n: f64,
    /// The middle between the least and the greatest displacement as recorded (m). No force depends on it.
    pub displacement_offset_m: f64,
}

/// About its zero a force reaches this share of half its range in both directions, or its median is no guess of that zero.
const BALANCED: f64 = 0.25;

/// A guess of what the sensor shows at no force, from forces with these ends: a damper pulls and pushes for about as long, so their median; 0
/// where the forces about it are in one direction. It decides where a test begins to count, and nothing else.
fn zero_guess_n(forces: &[f64], [least, greatest]: [f64; 2]) -> f64 {
    let mut sorted = forces.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted[sorted.len() / 2];
    let enough = BALANCED * 0.5 * (greatest - least);
    if greatest - median > enough && median - least > enough {
        median
    } else {
        0.0
    }
}

impl LoopTest {
    /// The tests of a recording, one for each stretch without gaps, at ticks of `step_s` (s).
    ///
    /// # Errors
    /// Too few samples, too many ticks, or a force that never acts in both directions.
    pub fn of(recorded: &Recorded, step_s: f64) -> Result<Vec<Self>, CalibrationError> {
        let (stretches, _) = recorded.tests();
        let count = stretches.len();
        let tests = stretches.into_iter().enumerate().map(|(number, stretch)| {
            let name = match count {
                1 => recorded.name.clone(),
                _ => format!("{} ({} of {count})", recorded.name, number + 1),
            };
            Self::of_stretch(name, recorded, stretch, step_s)
        });
        let tests: Vec<Self> = tests.collect::<Result<_, _>>()?;
        if tests.is_empty() {
            return Err(CalibrationError::TooShort {
                test: recorded.name.clone(),
                fewest: FEWEST_SAMPLES,
            });
        }
        Ok(tests)
    }

    fn of_stretch(
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
        if last > MOST_TICKS {
            return Err(CalibrationError::TooLong {
                test: name,
                seconds: last * step_s,
                most: MOST_TICKS * step_s,
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
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let greatest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            (least, greatest)
        };
        let (shortest, longest) = span(&x);
        let (compression, extension) = span(&force.values);
        let peak_force_n = extension.max(-compression);
        let force_half_range_n = 0.5 * (extension - compression);
        let zero_n = zero_guess_n(&force.values, [compression, extension]);
        let reaches = |sign: f64| {
            let reached = |force: &f64| sign * (force - zero_n) > CONTACT * force_half_range_n;
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
            displacements_m: x,
            positions,
            forces_n,
            name,
        })
    }

    /// The same test with its displacements and forces multiplied by these factors.
    pub(super) fn scaled(&self, [of_x, of_force]: [f64; 2]) -> Self {
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

    /// Root mean square of the velocity (m/s), at ticks of `step_s` (s).
    pub(super) fn rms_velocity_m_per_s(&self, step_s: f64) -> f64 {
        let pairs = self.displacements_m.windows(2);
        let square: f64 = pairs.map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        (square / self.displacements_m.len() as f64).sqrt() / step_s
    }

    /// The work that the recorded force takes from the motion (J), and the sum of the magnitudes of its parts (J). The mean force is left out, for
    /// an offset of the sensor takes no work on a closed path.
    pub(super) fn work_j(&self) -> [f64; 2] {
        let (x, forces) = (self.counted_displacements_m(), self.counted_forces_n());
        let mean = forces.iter().sum::<f64>() / forces.len().max(1) as f64;
        let moved = x.windows(2).map(|pair| pair[1] - pair[0]);
        let parts = forces
            .windows(2)
            .zip(moved)
            .map(|(pair, moved)| (0.5 * (pair[0] + pair[1]) - mean) * moved);
        parts.fold([0.0, 0.0], |[work, size], part| {
            [work + part, size + part.abs()]
        })
    }

    /// The forces that count (N).
    pub fn counted_forces_n(&self) -> &[f64] {
        &self.forces_n[self.counted.clone()]
    }

    /// Displacements at the samples that count (m).
    pub fn counted_displacements_m(&self) -> Vec<f64> {
        self.at_counted(&self.displacements_m, 0.0)
    }

    /// Velocities at the samples that count (m/s), at ticks of `step_s` (s).
    pub fn counted_velocities_m_per_s(&self, step_s: f64) -> Vec<f64> {
        let pairs = self.displacements_m.windows(2);
        let velocities: Vec<f64> = pairs.map(|pair| (pair[1] - pair[0]) / step_s).collect();
        // Each is that of the middle between two ticks.
        self.at_counted(&velocities, 0.5)
    }

    /// Times of the samples that count (s), from the first of the test.
    pub fn counted_times_s(&self, step_s: f64) -> Vec<f64> {
        let counted = &self.positions[self.counted.clone()];
        counted.iter().map(|position| position * step_s).collect()
    }

    /// Values at ticks, taken `later` ticks before each sample that counts, linear between.
    pub(super) fn at_counted(&self, values: &[f64], later: f64) -> Vec<f64> {
        let last = values.len() - 1;
        self.positions[self.counted.clone()]
            .iter()
            .map(|position| {
                let position = (position - later).clamp(0.0, last as f64);
                let tick = (position as usize).min(last - 1);
                let fraction = position - tick as f64;
                values[tick] + fraction * (values[tick + 1] - values[tick])
            })
            .collect()
    }
}
