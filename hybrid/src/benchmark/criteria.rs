//! The criteria J1 to J9 by which the benchmark compares tests.

use serde::Serialize;

use super::RATE_HZ;

/// Criteria of one run. All but the delay are in percent.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Criteria {
    /// J1: delay of the measured displacement at which it correlates best with the desired one, 0 to 49 ticks (ms).
    pub j1_ms: f64,
    /// J2: root mean square of measured minus desired displacement, relative to the desired one.
    pub j2_percent: f64,
    /// J3: the same of peaks.
    pub j3_percent: f64,
    /// J4: root mean square of the first storey's displacement minus that of the whole frame, relative to the latter.
    pub j4_percent: f64,
    /// J5: the same of peaks.
    pub j5_percent: f64,
    /// J6 and J7: like J4 for the second and third storey.
    pub j6_percent: f64,
    /// See `j6_percent`.
    pub j7_percent: f64,
    /// J8 and J9: like J5 for the second and third storey.
    pub j8_percent: f64,
    /// See `j8_percent`.
    pub j9_percent: f64,
    /// J2 of the displacement that the specimen reached, without noise and resolution of the sensor.
    pub reached_percent: f64,
}

/// Signals of a run (m at each tick).
#[derive(Clone, Debug, Default)]
pub(super) struct Signals {
    pub(super) measured: Vec<f64>,
    pub(super) reached: Vec<f64>,
    /// Storeys of the simulated part; the first is the desired displacement.
    pub(super) simulated: [Vec<f64>; 3],
    /// Storeys of the whole frame.
    pub(super) reference: [Vec<f64>; 3],
}

impl Criteria {
    pub(super) fn of(signals: &Signals) -> Self {
        let desired = &signals.simulated[0];
        let [one, two, three] = &signals.reference;
        Self {
            j1_ms: delay_ticks(&signals.measured, desired) as f64 / RATE_HZ * 1e3,
            j2_percent: spread_percent(&signals.measured, desired),
            j3_percent: peak_percent(&signals.measured, desired),
            j4_percent: spread_percent(&signals.measured, one),
            j5_percent: peak_percent(&signals.measured, one),
            j6_percent: spread_percent(&signals.simulated[1], two),
            j7_percent: spread_percent(&signals.simulated[2], three),
            j8_percent: peak_percent(&signals.simulated[1], two),
            j9_percent: peak_percent(&signals.simulated[2], three),
            reached_percent: spread_percent(&signals.reached, desired),
        }
    }
}

/// Standard deviation.
fn spread(numbers: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = numbers.clone().count().max(1) as f64;
    let mean = numbers.clone().sum::<f64>() / count;
    libm::sqrt(numbers.map(|x| (x - mean) * (x - mean)).sum::<f64>() / count)
}

fn spread_percent(ours: &[f64], other: &[f64]) -> f64 {
    let difference = ours.iter().zip(other).map(|(a, b)| a - b);
    100.0 * spread(difference) / spread(other.iter().copied())
}

fn peak_percent(ours: &[f64], other: &[f64]) -> f64 {
    let peak = |peak: f64, x: f64| peak.max(x.abs());
    let difference = ours.iter().zip(other).map(|(a, b)| a - b);
    100.0 * difference.fold(0.0, peak) / other.iter().copied().fold(0.0, peak)
}

/// Number of ticks, 0 to 49, by which `late` correlates best with `early`.
fn delay_ticks(late: &[f64], early: &[f64]) -> usize {
    let correlation = |delay: usize| {
        let count = early.len().saturating_sub(delay);
        let pairs = || late[early.len() - count..].iter().zip(&early[..count]);
        let n = count.max(1) as f64;
        let (a, b) = pairs().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
        let (product, xx, yy) = pairs().fold((0.0, 0.0, 0.0), |(product, xx, yy), (x, y)| {
            let (x, y) = (x - a, y - b);
            (product + x * y, xx + x * x, yy + y * y)
        });
        product / libm::sqrt(xx * yy)
    };
    let best = (0..50).map(|delay| (delay, correlation(delay)));
    best.max_by(|(_, a), (_, b)| a.total_cmp(b))
        .map_or(0, |(delay, _)| delay)
}
