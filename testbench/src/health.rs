//! Condition of a damper over time, estimated from recorded displacement and force.

use std::f64::consts::TAU;

use dashpot_core::health::{Estimate, Health, HealthModel, HealthReading, HealthStatus};
use fastrand::Rng;

use super::smoothing::smooth;
use dashpot_recording::stretches::{median_interval, stretches};

/// Standard deviations of the white noise of both sensors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Displacement noise (m).
    pub displacement_m: f64,
    /// Force noise (N).
    pub force_n: f64,
}

impl Noise {
    /// Returns noise that is a fraction (1) of the rms of each signal about its mean.
    pub fn from_rms(fraction: f64, displacements_m: &[f64], forces_n: &[f64]) -> Self {
        Self {
            displacement_m: fraction * rms(displacements_m),
            force_n: fraction * rms(forces_n),
        }
    }

    /// Returns both signals with noise added, from a generator with this seed.
    pub fn add_to(
        &self,
        displacements_m: &[f64],
        forces_n: &[f64],
        seed: u64,
    ) -> (Vec<f64>, Vec<f64>) {
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

    /// Estimates the noise of a recording as it appears at ticks of `step_s` (s); `None` if no stretch is long enough.
    ///
    /// The noise is the residual of a smoothing spline over the longest stretch without a gap, but at least 1e-4 of the
    /// signal's rms, because no sensor is better. If the ticks are closer together than the samples, consecutive ticks
    /// share the noise of one sample; the returned standard deviation is then larger to account for that.
    pub fn estimate(
        times_s: &[f64],
        displacements_m: &[f64],
        forces_n: &[f64],
        step_s: f64,
    ) -> Option<Self> {
        const MIN_SAMPLES: usize = 100;
        const MIN_SHARE_OF_RMS: f64 = 1e-4;
        let interval_s = median_interval(times_s)?;
        let stretches = stretches(times_s).into_iter();
        let stretch = stretches.max_by_key(std::ops::Range::len)?;
        if stretch.len() < MIN_SAMPLES {
            return None;
        }
        let times_s = &times_s[stretch.clone()];
        let positions: Vec<f64> = times_s
            .iter()
            .map(|time_s| (time_s - times_s[0]) / interval_s)
            .collect();
        let ticks = positions.last().copied().unwrap_or(0.0) as usize + 2;
        let ticks_per_sample = (interval_s / step_s).max(1.0);
        let noise_of = |signal: &[f64]| {
            let signal = &signal[stretch.clone()];
            let noise = smooth(&positions, signal, ticks).noise;
            noise.max(MIN_SHARE_OF_RMS * rms(signal)) * ticks_per_sample.sqrt()
        };
        Some(Self {
            displacement_m: noise_of(displacements_m),
            force_n: noise_of(forces_n),
        })
    }
}

/// Returns the root mean square about the mean.
fn rms(signal: &[f64]) -> f64 {
    let count = signal.len().max(1) as f64;
    let mean = signal.iter().sum::<f64>() / count;
    let square = signal
        .iter()
        .map(|value| (value - mean).powi(2))
        .sum::<f64>();
    (square / count).sqrt()
}

/// Returns a standard normal random number (Box and Muller 1958); `libm` gives the same value on every machine.
pub(super) fn normal(rng: &mut Rng) -> f64 {
    let radius = (-2.0 * libm::log(1.0 - rng.f64())).sqrt();
    radius * libm::cos(TAU * rng.f64())
}

/// Estimates at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Time since the first sample (s).
    pub time_s: f64,
    /// The estimates.
    pub reading: HealthReading,
    /// Least and greatest force since the reading before (N).
    pub force_n: [f64; 2],
    /// Share of the samples since the reading before that the estimate used: those with the mount in contact.
    pub used_share: f64,
}

/// Samples between two readings.
struct Interval {
    force_n: [f64; 2],
    samples: u64,
    /// Samples that the estimate had used at the start.
    used_before: u32,
}

impl Interval {
    fn new(used_before: u32) -> Self {
        Self {
            force_n: [f64::INFINITY, f64::NEG_INFINITY],
            samples: 0,
            used_before,
        }
    }

    fn add(&mut self, force_n: f64) {
        let [least, greatest] = self.force_n;
        self.force_n = [least.min(force_n), greatest.max(force_n)];
        self.samples += 1;
    }

    fn reading(&self, time_s: f64, reading: HealthReading) -> Reading {
        let used = reading.samples.saturating_sub(self.used_before);
        Reading {
            time_s,
            reading,
            force_n: self.force_n,
            // A block is counted when it is complete, so it may belong to the interval before.
            used_share: (f64::from(used) / self.samples.max(1) as f64).min(1.0),
        }
    }
}

/// Drops every second reading; the other one then covers both intervals.
fn halve(readings: &mut Vec<Reading>) {
    let merged = readings.chunks_exact(2).map(|pair| {
        let [before, after] = [pair[0], pair[1]];
        Reading {
            force_n: [
                before.force_n[0].min(after.force_n[0]),
                before.force_n[1].max(after.force_n[1]),
            ],
            used_share: 0.5 * (before.used_share + after.used_share),
            ..after
        }
    });
    *readings = merged.collect();
}

/// Estimates over a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Baseline and alarm limits.
    pub model: HealthModel,
    /// Readings in order of time; the last follows the last sample.
    pub readings: Vec<Reading>,
    /// Each alarm that was raised, and when it was first raised (s).
    pub alarms: Vec<(HealthStatus, f64)>,
}

/// Alarms and their names.
pub const ALARMS: [(HealthStatus, &str); 5] = [
    (HealthStatus::FLOW, "flow"),
    (HealthStatus::STIFFNESS, "stiffness"),
    (HealthStatus::CLEARANCE, "clearance"),
    (HealthStatus::NO_FORCE, "no force"),
    (HealthStatus::FORCE_ZERO, "force zero"),
];

/// Returns the name of an alarm; empty for any other status bit.
pub fn alarm_name(alarm: HealthStatus) -> &'static str {
    let known = ALARMS.iter().find(|(known, _)| *known == alarm);
    known.map_or("", |(_, name)| name)
}

/// Describes an alarm in a sentence without a full stop; `last` is the last reading.
pub fn alarm_in_words(alarm: HealthStatus, last: &HealthReading) -> String {
    if alarm == HealthStatus::NO_FORCE {
        return "NO FORCE: the damper moved, but the measured force did not follow. The force channel is dead or stuck, \
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

/// Lists the reasons why the intervals of a reading may not contain the true values, one sentence without a full stop
/// per reason; empty if the reading can be trusted.
pub fn doubts_in_words(reading: &HealthReading) -> Vec<String> {
    let HealthReading {
        status,
        samples,
        rejected,
        ..
    } = *reading;
    let sentences = [
        (
            HealthStatus::NO_FORCE,
            "do not trust the estimates: the force did not follow the displacement",
        ),
        (
            HealthStatus::LATE,
            "do not trust stiffness and clearance: force and displacement are further apart in time than the model \
             assumes; measure the lag, which a calibration calls sensor_skew_s, and enter it in the health model",
        ),
        (
            HealthStatus::SEVERAL_CHANGED,
            "do not trust the estimates: two or more of flow, stiffness and clearance have changed together, as \
             they do if a sensor has the wrong scale or sign, or if the displacement is stuck; check the sensors",
        ),
        (
            HealthStatus::MISFIT,
            "do not trust the estimates: the measured force does not fit the model of this damper",
        ),
    ];
    let found = sentences.into_iter();
    let found = found.filter(|(bit, _)| status.contains(*bit));
    let mut doubts: Vec<String> = found.map(|(_, sentence)| sentence.to_owned()).collect();
    if rejected > samples {
        doubts.push(format!(
            "do not trust the estimates: {rejected} samples were left out and only {samples} used, because \
             displacement or force is not finite, or more than this damper can have; check channels and units"
        ));
    }
    doubts
}

/// Formats an estimate and its standard deviation in whole units: `205 ± 7`.
pub fn whole_in_words(estimate: Estimate) -> String {
    format!("{:.0} ± {:.0}", estimate.value, estimate.sd)
}

/// Formats an estimate and its standard deviation, both multiplied by `scale`: `1.604 ± 0.012`.
pub fn in_words(estimate: Estimate, scale: f32) -> String {
    let (value, sd) = (estimate.value * scale, estimate.sd * scale);
    format!("{value:.3} ± {sd:.3}")
}

/// Formats a stiffness (N/m) in MN/m like [`in_words`]; if its compliance does not differ from zero by two standard
/// deviations, formats the lower bound of the stiffness instead: `above 12.1`.
pub fn stiffness_in_words(stiffness: Estimate, compliance: Estimate) -> String {
    let Estimate { value, sd } = compliance;
    let max_compliance = value + 2.0 * sd;
    if value > 2.0 * sd {
        in_words(stiffness, 1e-6)
    } else if max_compliance > 0.0 {
        format!("above {:.3}", 1e-6 / max_compliance)
    } else {
        "unknown".into()
    }
}

/// Maximum number of readings kept.
const MAX_READINGS: usize = 4000;

/// Runs the estimator over samples of displacement (m) and force (N), one per step of `model`, and keeps a reading
/// every `every_s` (s).
///
/// The interval doubles whenever 4000 readings are kept: every second one is then dropped. A missing sample has NaN as
/// its displacement.
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
    let mut interval = Interval::new(0);
    for (displacement_m, force_n) in samples {
        interval.add(force_n);
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
            if history.readings.len() == MAX_READINGS {
                halve(&mut history.readings);
                every *= 2;
            }
            if count.is_multiple_of(every) {
                let reading = health.reading(model);
                history.readings.push(interval.reading(time_s, reading));
                interval = Interval::new(reading.samples);
            }
        }
    }
    if !count.is_multiple_of(every) {
        let time_s = (count - 1) as f64 * step_s;
        let reading = health.reading(model);
        history.readings.push(interval.reading(time_s, reading));
    }
    history
}

impl History {
    /// Returns the last reading; `None` if there were no samples.
    pub fn last(&self) -> Option<&HealthReading> {
        self.readings.last().map(|reading| &reading.reading)
    }
}
