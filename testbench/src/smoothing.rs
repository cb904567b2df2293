//! Recorded samples as a smooth motion on ticks, and how noisy they are.

use fastrand::Rng;

/// Samples at their times as values at ticks.
pub struct Smooth {
    /// Values at ticks 0, 1, 2, ...
    pub values: Vec<f64>,
    /// Standard deviation of the samples about them.
    pub noise: f64,
}

/// Decades of lambda that are tried, and how many values a decade: from samples followed exactly to a straight line.
const DECADES: std::ops::RangeInclusive<i32> = -4..=16;
const A_DECADE: i32 = 2;

/// Share of the samples that must be free for the score to be more than rounding.
const LEAST_FREEDOM: f64 = 1e-6;

/// The values `z` at ticks with the least `sum (x_i - z(t_i))^2 + lambda sum (second difference of z)^2`, `z` linear between
/// ticks: a smoothing spline. Lambda is the one of least generalised cross validation (Craven and Wahba, Numer. Math. 31, 1979),
/// the trace of the smoother by one random vector (Girard, Numer. Math. 56, 1989), so that white noise goes and the motion stays
/// whatever its frequency.
///
/// `positions` are the samples' times in ticks, rising from 0; `ticks` is above the last.
pub fn smooth(positions: &[f64], samples: &[f64], ticks: usize) -> Smooth {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let centred: Vec<f64> = samples.iter().map(|sample| sample - mean).collect();
    // Signs of equal chance have the least scatter of the trace.
    let mut rng = Rng::with_seed(0x5eed);
    let signs: Vec<f64> = samples
        .iter()
        .map(|_| if rng.bool() { 1.0 } else { -1.0 })
        .collect();
    let places = Places::new(positions, ticks);
    let [sums, sign_sums] = [&centred, &signs].map(|values| places.gather(values));
    let mut best: Option<(f64, Smooth)> = None;
    let count = samples.len() as f64;
    for exponent in DECADES.start() * A_DECADE..=DECADES.end() * A_DECADE {
        let lambda = 10_f64.powf(f64::from(exponent) / f64::from(A_DECADE));
        let factors = places.factors(lambda);
        let values = factors.solve(&sums);
        let square: f64 = places
            .at_samples(&values)
            .zip(&centred)
            .map(|(value, sample)| (sample - value).powi(2))
            .sum();
        let of_signs = factors.solve(&sign_sums);
        let trace: f64 = places
            .at_samples(&of_signs)
            .zip(&signs)
            .map(|(value, sign)| value * sign)
            .sum();
        let freedom = count - trace;
        if freedom < LEAST_FREEDOM * count {
            continue;
        }
        let score = square / (freedom * freedom);
        if best.as_ref().is_none_or(|(least, _)| score < *least) {
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

/// Where the samples lie among the ticks: the tick before, and the fraction on to the next.
struct Places {
    of_samples: Vec<(usize, f64)>,
    ticks: usize,
}

impl Places {
    fn new(positions: &[f64], ticks: usize) -> Self {
        let place = |position: &f64| {
            let tick = (position.floor() as usize).min(ticks - 2);
            (tick, position - tick as f64)
        };
        Self {
            of_samples: positions.iter().map(place).collect(),
            ticks,
        }
    }

    /// `B^T x`, B the interpolation.
    fn gather(&self, samples: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.ticks];
        for ((tick, fraction), sample) in self.of_samples.iter().zip(samples) {
            sums[*tick] += (1.0 - fraction) * sample;
            sums[tick + 1] += fraction * sample;
        }
        sums
    }

    /// `B z`.
    fn at_samples<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.of_samples
            .iter()
            .map(|(tick, fraction)| (1.0 - fraction) * values[*tick] + fraction * values[tick + 1])
    }

    /// The factors of `B^T B + lambda D^T D`, D the second difference.
    fn factors(&self, lambda: f64) -> Factors {
        let mut rows = vec![[0.0; 3]; self.ticks];
        for (tick, fraction) in &self.of_samples {
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

/// `L D L^T` of a symmetric matrix of five diagonals.
struct Factors {
    /// Of each row the pivot, and the two entries of L below it.
    rows: Vec<[f64; 3]>,
}

impl Factors {
    /// Of rows that each hold the diagonal and the two entries right of it.
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
    fn noise_goes_and_the_motion_stays_at_any_frequency_and_rate() {
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
            // One value for each sample and one for the estimate: chi-square of n.
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
            // The spline passes 1/(1 + (w/c)^4): of the noise the integral of its square, 0.833 c/pi (w, c a sample); of a line of mean
            // square 1/2 it lacks (w/c)^4. Least in all:
            let (line, noise) = (TAU * frequency_hz / rate_hz, 0.02 * 0.02 * 0.833 / PI);
            let cut = (4.0 * line.powi(8) / noise).powf(1.0 / 9.0);
            let least = (noise * cut + 0.5 * (line / cut).powi(8)).sqrt();
            assert!(rms < 1.4 * least, "{frequency_hz} Hz: {rms}, least {least}");
        }
    }

    #[test]
    fn a_straight_line_is_kept_and_has_no_noise() {
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
