//! Motions of the seats.

use std::f64::consts::PI;

/// Times [s] and displacements [m].
pub type Motion = (Vec<f64>, Vec<f64>);

/// `displacement` sampled at `rate` [Hz] for `duration` [s].
pub fn sampled(rate: f64, duration: f64, displacement: impl Fn(f64) -> f64) -> Motion {
    let count = (duration * rate).round() as usize;
    let times: Vec<f64> = (0..=count).map(|i| i as f64 / rate).collect();
    let values = times.iter().map(|t| displacement(*t)).collect();
    (times, values)
}

/// Sum of harmonics between 0.3 and 20 Hz with phases from a fixed sequence; the RMS velocity is about
/// 0.04 m/s.
pub fn ride(rate: f64, duration: f64) -> Motion {
    let mut seed = 0x2545_f491_4f6c_dd1d_u64;
    let mut uniform = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let harmonics: Vec<(f64, f64, f64)> = (0..40)
        .map(|i| {
            let frequency = 0.3 * (20.0_f64 / 0.3).powf((i as f64 + uniform()) / 40.0);
            let omega = 2.0 * PI * frequency;
            (
                omega,
                0.04 * (2.0_f64 / 40.0).sqrt() / omega,
                2.0 * PI * uniform(),
            )
        })
        .collect();
    sampled(rate, duration, |t| {
        harmonics
            .iter()
            .map(|(omega, amplitude, phase)| amplitude * (omega * t + phase).sin())
            .sum()
    })
}

/// Exponential sweep of 0.8 mm from 0.2 to 25 Hz.
pub fn sweep(rate: f64, duration: f64) -> Motion {
    let (low, high) = (0.2, 25.0_f64);
    let growth = (high / low).ln() / duration;
    sampled(rate, duration, |t| {
        0.8e-3 * (2.0 * PI * low * ((growth * t).exp() - 1.0) / growth).sin()
    })
}

/// Saw of 2 mm at 0.08 m/s for 0.5 s, then rest.
pub fn saw(rate: f64, duration: f64) -> Motion {
    let at = |t: f64| {
        let phase = (t * 10.0).fract();
        let triangle = if phase < 0.25 {
            4.0 * phase
        } else if phase < 0.75 {
            2.0 - 4.0 * phase
        } else {
            4.0 * phase - 4.0
        };
        2e-3 * triangle
    };
    sampled(rate, duration, |t| at(t.min(0.52)))
}

/// A pull of 3 mm in 20 ms, then rest.
pub fn decay(rate: f64, duration: f64) -> Motion {
    sampled(rate, duration, |t| 3e-3 * (t / 0.02).min(1.0))
}
