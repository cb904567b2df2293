//! Fourier transforms of whole signals. They are compiled once, here, because the library makes its callers compile
//! all of its algorithms.

use nalgebra::Complex;
use realfft::RealFftPlanner;

/// Returns the complex amplitudes of the lines of a signal, from 0 to half its rate, divided by the number of values.
/// Line n has n periods in the signal. The values are overwritten.
///
/// ```
/// use dashpot_rail::indices::{amplitudes, signal_of};
/// let mut wave: Vec<f64> = (0..8).map(|n| (std::f64::consts::TAU * f64::from(n) / 8.0).cos()).collect();
/// let lines = amplitudes(&mut wave);
/// assert!((lines[1].re - 0.5).abs() < 1e-15 && lines[2].norm() < 1e-15);
/// assert!((signal_of(&lines, 16)[8] + 1.0).abs() < 1e-15);
/// ```
pub fn amplitudes(signal: &mut [f64]) -> Vec<Complex<f64>> {
    if signal.is_empty() {
        return Vec::new();
    }
    let plan = RealFftPlanner::new().plan_fft_forward(signal.len());
    let mut lines = plan.make_output_vec();
    // Cannot fail: the lengths match the plan.
    let _ = plan.process(signal, &mut lines);
    let scale = 1.0 / signal.len() as f64;
    lines.iter_mut().for_each(|line| *line *= scale);
    lines
}

/// Returns a signal of `count` values from its [`amplitudes`]; missing lines are zero, and further ones are left out.
pub fn signal_of(lines: &[Complex<f64>], count: usize) -> Vec<f64> {
    if count == 0 {
        return Vec::new();
    }
    let plan = RealFftPlanner::new().plan_fft_inverse(count);
    let mut input = plan.make_input_vec();
    for (to, from) in input.iter_mut().zip(lines) {
        *to = *from;
    }
    // A real signal has a real mean, and a real line at half its rate.
    for line in [0, count / 2] {
        if line == 0 || count.is_multiple_of(2) {
            input[line].im = 0.0;
        }
    }
    let mut signal = plan.make_output_vec();
    let _ = plan.process(&mut input, &mut signal);
    signal
}
