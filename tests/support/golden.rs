//! The motions of `tests/golden/forces.txt`. They use `libm` instead of the machine's own sine, so that the input is
//! the same on every machine.

use std::f64::consts::TAU;

/// Step (s).
pub const STEP_S: f64 = 1e-3;
/// Number of steps.
pub const TICKS: u32 = 4000;

/// A motion: name and displacement (m) at a time (s).
pub type Motion = (&'static str, fn(f64) -> f64);

/// Golden motions by name.
pub const MOTIONS: [Motion; 4] = [
    ("ride", |t| {
        (1..=20)
            .map(f64::from)
            .map(|line| 2e-3 / line * libm::sin(TAU * 0.71 * line * t + line * line))
            .sum()
    }),
    ("sweep", |t| 0.8e-3 * libm::sin(TAU * 3.0 * t * t)),
    ("saw", |t| {
        let phase = 2.0 * t - libm::floor(2.0 * t);
        if t < 3.0 {
            0.05 * (0.25 - (phase - 0.5).abs())
        } else {
            -0.0125
        }
    }),
    ("decay", |t| {
        0.01 * libm::exp(-2.0 * t) * libm::sin(TAU * 1.4 * t)
    }),
];
