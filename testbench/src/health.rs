//! Health of a damper from recorded displacement and force: the estimates over time.

use std::f64::consts::TAU;

use dashpot_core::health::{Estimate, Health, HealthModel, HealthReading, HealthStatus};
use fastrand::Rng;

use super::smoothing::smooth;
use dashpot_recording::stretches::{median_interval, stretches};

/// Standard deviations of white noise, one for each sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Of the displacement (m).
    pub displacement_m: f64,
    /// Of the force (N).
    pub force_n: f64,
}

impl Noise {
    /// This part (1) of the root mean square of either signal about its mean.
    pub fn of_rms(part: f64, displacements_m: &[f64], forces_n: &[f64]) -> Self {
        Self {
            displacement_m: part * rms(displacements_m),
            force_n: part * rms(forces_n),
        }
    }

    /// Both signals with noise of this seed.
    pub fn on(&self, displacements_m: &[f64], forces_n: &[f64], seed: u64) -> (Vec<f64>, Vec<f64>) {
        let mut rng = Rng::with_seed(seed);
        let mut noisy = |signal: &[f64], sd: f64| -> Vec<f64> {
            signal
                .iter()
                .map(|value| value + sd * normal(&mut rng))
                .collect()
        };
        (
            noisy(displacements_m, self.displacement_m),
            noisy(forces_n, self.force_n),
        )
    }

    /// What is noise in samples at `times_s` (s), as the ticks of `step_s` (s) between them have it: what a smoothing spline leaves of the
    /// longest stretch without a gap, at least a ten-thousandth of its root mean square, for no sensor is better. Ticks that are closer
    /// than the samples repeat one noise, which counts as a greater one of each. `None` where no stretch is long enough.
    pub fn found_in(
        times_s: &[f64],
        displacements_m: &[f64],
        forces_n: &[f64],
        step_s: f64,
    ) -> Option<Self> {
        /// Fewer tell nothing.
        const FEWEST: usize = 100;
        const LEAST: f64 = 1e-4;
        let interval_s = median_interval(times_s)?;
        let stretches = stretches(times_s).into_iter();
        let stretch = stretches.max_by_key(std::ops::Range::len)?;
        if stretch.len() < FEWEST {
            return None;
        }
        let times_s = &times_s[stretch.clone()];
        let positions: Vec<f64> = times_s
            .iter()
            .map(|time_s| (time_s - times_s[0]) / interval_s)
            .collect();
        let ticks = positions.last().copied().unwrap_or(0.0) as usize + 2;
        let ticks_a_sample = (interval_s / step_s).max(1.0);
        let of = |signal: &[f64]| {
            let signal = &signal[stretch.clone()];
            let noise = smooth(&positions, signal, ticks).noise;
            noise.max(LEAST * rms(signal)) * ticks_a_sample.sqrt()
        };
        Some(Self {
            displacement_m: of(displacements_m),
            force_n: of(forces_n),
        })
    }
}

/// Root mean square about the mean.
fn rms(signal: &[f64]) -> f64 {
    let count = signal.len().max(1) as f64;
    let mean = signal.iter().sum::<f64>() / count;
    let square = signal
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>();
    (square / count).sqrt()
}

/// A normal number (Box and Muller 1958), with functions that are the same on every machine.
pub(super) fn normal(rng: &mut Rng) -> f64 {
    let radius = (-2.0 * libm::log(1.0 - rng.f64())).sqrt();
    radius * libm::cos(TAU * rng.f64())
}

/// What was known at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Time since the first sample (s).
    pub time_s: f64,
    /// The estimates.
    pub reading: HealthReading,
}

/// Estimates over a run.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// What it was compared with and by which limits.
    pub model: HealthModel,
    /// In order of time, the last after the last sample.
    pub readings: Vec<Reading>,
    /// When each alarm was first raised (s).
    pub alarms: Vec<(HealthStatus, f64)>,
}

/// The alarms and what they are called.
pub const ALARMS: [(HealthStatus, &str); 5] = [
    (HealthStatus::FLOW, "flow"),
    (HealthStatus::STIFFNESS, "stiffness"),
    (HealthStatus::CLEARANCE, "clearance"),
    (HealthStatus::NO_FORCE, "no force"),
    (HealthStatus::FORCE_ZERO, "force zero"),
];

/// The name of an alarm; empty where it is none.
pub fn alarm_name(alarm: HealthStatus) -> &'static str {
    let known = ALARMS.iter().find(|(known, _)| *known == alarm);
    known.map_or("", |(_, name)| name)
}

/// An alarm as a sentence without its end; `last` is the reading at the end.
pub fn alarm_in_words(alarm: HealthStatus, last: &HealthReading) -> String {
    if alarm == HealthStatus::NO_FORCE {
        return "NO FORCE: the damper moved and the measured force did not follow. The force channel is dead or stuck, \
                the oil is full of air, or the clearance is wider than the motion"
            .into();
    }
    if alarm == HealthStatus::FORCE_ZERO {
        return format!(
            "the zero of the force sensor is off by {} N; the other estimates are corrected for it",
            whole_in_words(last.force_zero_n)
        );
    }
    format!("{} differs from the baseline", alarm_name(alarm))
}

/// Why the intervals of a reading may not contain the truth, a sentence each; none where it can be trusted.
pub fn doubts_in_words(status: HealthStatus) -> Vec<&'static str> {
    let sentences = [
        (
            HealthStatus::NO_FORCE,
            "do not trust the estimates: the force did not follow the displacement",
        ),
        (
            HealthStatus::LATE,
            "do not trust stiffness and clearance: force and displacement are further apart in time than is known; \
             measure the lag and give it as --lag-s",
        ),
        (
            HealthStatus::SEVERAL_CHANGED,
            "do not trust the estimates: two or more of flow, stiffness and clearance have changed together, as with a \
             wrong scale or sign of a sensor or a stuck displacement; check the sensors",
        ),
        (
            HealthStatus::MISFIT,
            "do not trust the estimates: what is measured does not follow from the model of this damper",
        ),
    ];
    let found = sentences.into_iter();
    found
        .filter(|(bit, _)| status.contains(*bit))
        .map(|(_, sentence)| sentence)
        .collect()
}

/// An estimate in whole units and its standard deviation: `205 ± 7`.
pub fn whole_in_words(estimate: Estimate) -> String {
    format!("{:.0} ± {:.0}", estimate.value, estimate.sd)
}

/// An estimate, scaled to its unit, and its standard deviation: `1.604 ± 0.012`.
pub fn in_words(estimate: Estimate, scale: f32) -> String {
    let (value, sd) = (estimate.value * scale, estimate.sd * scale);
    format!("{value:.3} ± {sd:.3}")
}

/// A stiffness (N/m) in MN/m as [`in_words`]; where its compliance is not told from none, the least stiffness within two
/// standard deviations: `above 12.1`.
pub fn stiffness_in_words(stiffness: Estimate, compliance: Estimate) -> String {
    let Estimate { value, sd } = compliance;
    let most = value + 2.0 * sd;
    if value > 2.0 * sd {
        in_words(stiffness, 1e-6)
    } else if most > 0.0 {
        format!("above {:.3}", 1e-6 / most)
    } else {
        "unknown".into()
    }
}

/// Most readings that are kept of a run.
const MOST_READINGS: usize = 4000;

/// Runs the estimator over samples of displacement (m) and force (N), one at each step of `model`, and keeps a
/// reading every `every_s` (s), every second of them again where a run is longer than 4000 readings. A sample that
/// is missing has NaN for its displacement.
pub fn watch(
    model: &HealthModel,
    samples: impl IntoIterator<Item = (f64, f64)>,
    every_s: f64,
) -> History {
    let step_s = f64::from(model.step_s());
    let mut every = (every_s / step_s).round().max(1.0) as u64;
    let mut health = Health::new(model);
    let mut history = History {
        model: *model,
        readings: Vec::new(),
        alarms: Vec::new(),
    };
    let mut raised = HealthStatus::empty();
    let mut count = 0_u64;
    for (displacement_m, force_n) in samples {
        health.tick(model, displacement_m as f32, force_n as f32);
        let time_s = count as f64 * step_s;
        count += 1;
        let new = health.status() - raised;
        for (alarm, _) in ALARMS {
            if new.contains(alarm) {
                history.alarms.push((alarm, time_s));
                raised |= alarm;
            }
        }
        if count.is_multiple_of(every) {
            if history.readings.len() == MOST_READINGS {
                let mut number = 0_usize;
                history.readings.retain(|_| {
                    number += 1;
                    number.is_multiple_of(2)
                });
                every *= 2;
            }
            if count.is_multiple_of(every) {
                let reading = health.reading(model);
                history.readings.push(Reading { time_s, reading });
            }
        }
    }
    if !count.is_multiple_of(every) {
        let time_s = (count - 1) as f64 * step_s;
        let reading = health.reading(model);
        history.readings.push(Reading { time_s, reading });
    }
    history
}

impl History {
    /// The last reading, `None` without samples.
    pub fn last(&self) -> Option<&HealthReading> {
        self.readings.last().map(|reading| &reading.reading)
    }
}
