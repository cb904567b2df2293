//! Smooths recorded samples onto a grid of ticks and estimates their noise.

use fastrand::Rng;

/// Smoothed samples.
pub struct Smooth {
    /// Values at ticks 0, 1, 2 and so on.
    pub values: Vec<f64>,
    /// Standard deviation of the samples about these values.
    pub noise: f64,
}

/// Range of lambda in decades: from interpolation of the samples to a straight line.
const DECADES: std::ops::RangeInclusive<i32> = -4..=16;
/// Values of lambda per decade.
const VALUES_PER_DECADE: i32 = 2;

/// Minimum degrees of freedom per sample; below this, rounding errors dominate the score.
const MIN_FREEDOM: f64 = 1e-6;

/// Fits a smoothing spline: the values `z` at ticks that minimise
/// `sum (x_i - z(t_i))^2 + lambda sum (second difference of z)^2`, with `z` linear between ticks.
///
/// Lambda minimises the generalised cross validation score (Craven and Wahba, Numer. Math. 31, 1979), with the trace of
/// the smoother estimated from one random vector (Girard, Numer. Math. 56, 1989). This removes white noise and keeps
/// the motion at any frequency.
///
/// `positions` are the times of the samples in ticks, rising from 0; `ticks` must exceed the last position.
pub fn smooth(positions: &[f64], samples: &[f64], ticks: usize) -> Smooth {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let centred: Vec<f64> = samples.iter().map(|sample| sample - mean).collect();
    // A vector of random signs gives the trace estimate with the smallest variance.
    let mut rng = Rng::with_seed(0x5eed);
    let signs: Vec<f64> = samples
        .iter()
        .map(|_| if rng.bool() { 1.0 } else { -1.0 })
        .collect();
    let interpolation = Interpolation::new(positions, ticks);
    let [sums, sign_sums] = [&centred, &signs].map(|values| interpolation.transposed(values));
    let mut best: Option<(f64, Smooth)> = None;
    let count = samples.len() as f64;
    for exponent in DECADES.start() * VALUES_PER_DECADE..=DECADES.end() * VALUES_PER_DECADE {
        let lambda = 10_f64.powf(f64::from(exponent) / f64::from(VALUES_PER_DECADE));
        let factors = interpolation.factors(lambda);
        let values = factors.solve(&sums);
        let square: f64 = interpolation
            .at_samples(&values)
            .zip(&centred)
            .map(|(value, sample)| (sample - value).powi(2))
            .sum();
        let of_signs = factors.solve(&sign_sums);
        let trace: f64 = interpolation
            .at_samples(&of_signs)
            .zip(&signs)
            .map(|(value, sign)| value * sign)
            .sum();
        let freedom = count - trace;
        if freedom < MIN_FREEDOM * count {
            continue;
        }
        let score = square / (freedom * freedom);
        if best.as_ref().is_none_or(|(min, _)| score < *min) {
            let noise = (square / freedom).sqrt();
            best = Some((score, Smooth { values, noise }));
        }
    }
    let mut smooth = best.map_or_else(
        || Smooth {
            values: vec![0.0; ticks],
            noise: 0.0,
        },
        |(_, smooth)| smooth,
    );
    for value in &mut smooth.values {
        *value += mean;
    }
    smooth
}

/// Linear interpolation from ticks to samples, the matrix B.
struct Interpolation {
    /// Tick before each sample, and the fraction of a tick from there to the sample.
    positions: Vec<(usize, f64)>,
    ticks: usize,
}

impl Interpolation {
    fn new(positions: &[f64], ticks: usize) -> Self {
        let split = |position: &f64| {
            let tick = (position.floor() as usize).min(ticks - 2);
            (tick, position - tick as f64)
        };
        Self {
            positions: positions.iter().map(split).collect(),
            ticks,
        }
    }

    /// Returns `B^T x`.
    fn transposed(&self, samples: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.ticks];
        for ((tick, fraction), sample) in self.positions.iter().zip(samples) {
            sums[*tick] += (1.0 - fraction) * sample;
            sums[tick + 1] += fraction * sample;
        }
        sums
    }

    /// Returns `B z`.
    fn at_samples<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.positions
            .iter()
            .map(|(tick, fraction)| (1.0 - fraction) * values[*tick] + fraction * values[tick + 1])
    }

    /// Factorises `B^T B + lambda D^T D`, where D is the second difference.
    fn factors(&self, lambda: f64) -> Factors {
        let mut rows = vec![[0.0; 3]; self.ticks];
        for (tick, fraction) in &self.positions {
            let rest = 1.0 - fraction;
            rows[*tick][0] += rest * rest;
            rows[*tick][1] += rest * fraction;
            rows[tick + 1][0] += fraction * fraction;
        }
        for tick in 0..self.ticks.saturating_sub(2) {
            for (row, entries) in [(0, &[1.0, -2.0, 1.0][..]), (1, &[4.0, -2.0]), (2, &[1.0])] {
                for (column, entry) in entries.iter().enumerate() {
                    rows[tick + row][column] += lambda * entry;
                }
            }
        }
        Factors::new(rows)
    }
}

/// Factors `L D L^T` of a symmetric pentadiagonal matrix.
struct Factors {
    /// For each row: the pivot and the two entries of L below it.
    rows: Vec<[f64; 3]>,
}

impl Factors {
    /// Factorises a matrix; each row holds the diagonal and the two entries right of it.
    fn new(mut rows: Vec<[f64; 3]>) -> Self {
        for row in 0..rows.len() {
            let [pivot, next, second] = rows[row];
            let (by_next, by_second) = (next / pivot, second / pivot);
            if let Some(below) = rows.get_mut(row + 1) {
                below[0] -= by_next * next;
                below[1] -= by_next * second;
            }
            if let Some(below) = rows.get_mut(row + 2) {
                below[0] -= by_second * second;
            }
            rows[row] = [pivot, by_next, by_second];
        }
        Self { rows }
    }

    fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut values = right.to_vec();
        for row in 0..values.len() {
            let [_, by_next, by_second] = self.rows[row];
            let value = values[row];
            if let Some(below) = values.get_mut(row + 1) {
                *below -= by_next * value;
            }
            if let Some(below) = values.get_mut(row + 2) {
                *below -= by_second * value;
            }
        }
        for row in (0..values.len()).rev() {
            let [pivot, by_next, by_second] = self.rows[row];
            let below = |offset: usize| values.get(row + offset).copied().unwrap_or(0.0);
            values[row] = values[row] / pivot - by_next * below(1) - by_second * below(2);
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::health::normal;

    #[test]
    fn smoothing_removes_noise_and_keeps_the_motion_at_any_frequency_and_rate() {
        let mut rng = Rng::with_seed(3);
        for (frequency_hz, rate_hz) in [(0.64, 1000.0), (1.9, 200.0), (12.0, 500.0), (0.3, 5000.0)]
        {
            let (step_s, duration_s) = (5e-4, 10.0);
            let motion = |time_s: f64| (TAU * frequency_hz * time_s).sin();
            let times: Vec<f64> = (0..(duration_s * rate_hz) as usize)
                .map(|sample| (sample as f64 + 0.3 * rng.f64()) / rate_hz)
                .collect();
            let start = times[0];
            let positions: Vec<f64> = times.iter().map(|time| (time - start) / step_s).collect();
            let samples: Vec<f64> = times
                .iter()
                .map(|time| motion(*time) + 0.02 * normal(&mut rng))
                .collect();
            let ticks = positions.last().unwrap().ceil() as usize + 2;
            let smooth = smooth(&positions, &samples, ticks);
            // The estimate of the noise has a chi-square distribution with as many degrees of freedom as samples.
            assert!(
                (smooth.noise / 0.02 - 1.0).abs() < 0.1,
                "{frequency_hz} Hz: {}",
                smooth.noise
            );
            let inside = 400..ticks - 400;
            let square: f64 = inside
                .clone()
                .map(|tick| (smooth.values[tick] - motion(start + tick as f64 * step_s)).powi(2))
                .sum();
            let rms = (square / inside.len() as f64).sqrt();
            // The gain of the spline is 1/(1 + (w/c)^4), with w and c in radians per sample. The integral of its square
            // gives the share of the noise that passes, 0.833 c/pi. A line of mean square 1/2 is attenuated by the
            // fraction (w/c)^4. The minimum of the sum of both errors is:
            let (line, noise) = (TAU * frequency_hz / rate_hz, 0.02 * 0.02 * 0.833 / PI);
            let cut = (4.0 * line.powi(8) / noise).powf(1.0 / 9.0);
            let min = (noise * cut + 0.5 * (line / cut).powi(8)).sqrt();
            assert!(rms < 1.4 * min, "{frequency_hz} Hz: {rms}, min {min}");
        }
    }

    #[test]
    fn a_straight_line_is_kept_and_is_free_of_noise() {
        let positions: Vec<f64> = (0..50).map(|sample| 1.5 * f64::from(sample)).collect();
        let samples: Vec<f64> = positions.iter().map(|at| 7.0 - 0.25 * at).collect();
        let smooth = smooth(&positions, &samples, 80);
        for (tick, value) in smooth.values.iter().enumerate() {
            assert!(
                (value - (7.0 - 0.25 * tick as f64)).abs() < 1e-6,
                "{tick}: {value}"
            );
        }
        assert!(smooth.noise < 1e-6);
    }
}
