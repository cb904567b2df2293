//! Spectra of signals of one duration.

use std::f64::consts::TAU;

use dashpot_rail::indices::{amplitudes, signal_of};
use nalgebra::Complex;

/// Highest frequency that is kept (Hz).
const HIGHEST_HZ: f64 = 40.0;

/// Lines of a signal's spectrum from 0 to 40 Hz, at multiples of the inverse of its duration.
#[derive(Debug, Clone)]
pub(super) struct Spectrum {
    duration_s: f64,
    lines: Vec<Complex<f64>>,
}

impl Spectrum {
    /// Transforms a signal of equally spaced values over `duration_s`.
    pub fn of(mut signal: Vec<f64>, duration_s: f64) -> Self {
        let mut lines = amplitudes(&mut signal);
        lines.truncate((HIGHEST_HZ * duration_s) as usize + 1);
        Self { duration_s, lines }
    }

    /// Transforms another signal of the same duration.
    pub fn of_signal(&self, signal: Vec<f64>) -> Self {
        let mut other = Self::of(signal, self.duration_s);
        other.lines.resize(self.lines.len(), Complex::ZERO);
        other
    }

    /// Returns the step (s) and the values of the signal at about `rate_hz`, with a whole number of steps.
    pub fn signal(&self, rate_hz: f64) -> (f64, Vec<f64>) {
        let count = ((rate_hz * self.duration_s).round() as usize).max(1);
        let step_s = self.duration_s / count as f64;
        (step_s, signal_of(&self.lines, count))
    }

    /// Returns the spectrum times a response, a function of the angular frequency (rad/s).
    pub fn times(&self, response: impl Fn(f64) -> Complex<f64>) -> Self {
        let step = TAU / self.duration_s;
        let lines = self.lines.iter().enumerate();
        let lines = lines.map(|(line, value)| value * response(line as f64 * step));
        Self {
            duration_s: self.duration_s,
            lines: lines.collect(),
        }
    }

    /// Returns the spectrum times a real response.
    pub fn scaled(&self, response: impl Fn(f64) -> f64) -> Self {
        self.times(|w| Complex::new(response(w), 0.0))
    }

    /// Returns the sum of spectra with their weights, all of the same duration.
    pub fn sum(&self, own: f64, others: &[(f64, &Self)]) -> Self {
        let mut sum = self.scaled(|_| own);
        for (weight, other) in others {
            for (line, addend) in sum.lines.iter_mut().zip(&other.lines) {
                *line += addend * *weight;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::Spectrum;

    #[test]
    fn a_signal_comes_back_at_another_rate() {
        let wave = |t: f64| 0.5 + (std::f64::consts::TAU * 3.0 * t).cos();
        let at = |rate: f64| {
            (0..(2.0 * rate) as usize)
                .map(|i| wave(i as f64 / rate))
                .collect::<Vec<f64>>()
        };
        let spectrum = Spectrum::of(at(128.0), 2.0);
        let (step_s, signal) = spectrum.signal(1000.0);
        assert_eq!((step_s, signal.len()), (1e-3, 2000));
        let error = signal
            .iter()
            .zip(at(1000.0))
            .map(|(one, other)| (one - other).abs());
        assert!(error.fold(0.0, f64::max) < 1e-12);
    }
}
