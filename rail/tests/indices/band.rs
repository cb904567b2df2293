//! Fourier transform of Sperling's index against the sums that define it.

use std::f64::consts::PI;

use dashpot_rail::indices::{RideDirection, SPERLING_BAND_HZ, sperling};

const RATE_HZ: f64 = 100.0;

/// `3.57 (sum A^3 F(f)/f)^0.1` with the amplitude `A` of each line.
fn defined(signal: &[f64], direction: RideDirection) -> f64 {
    let count = signal.len() as f64;
    let mean = signal.iter().sum::<f64>() / count;
    let mut sum = 0.0;
    for line in 1..=signal.len() / 2 {
        let f = line as f64 * RATE_HZ / count;
        if !(SPERLING_BAND_HZ[0]..=SPERLING_BAND_HZ[1]).contains(&f) {
            continue;
        }
        let (mut re, mut im) = (0.0, 0.0);
        for (i, value) in signal.iter().enumerate() {
            let (sin, cos) = (2.0 * PI * (line * i) as f64 / count).sin_cos();
            re += (value - mean) * cos;
            im += (value - mean) * sin;
        }
        sum += (2.0 / count * re.hypot(im)).powi(3) * direction.correction(f) / f;
    }
    3.57 * sum.powf(0.1)
}

/// Windows whose lengths are a power, a product of different primes, and a prime.
#[test]
fn windows_of_any_length_have_the_index_of_the_definition() {
    for samples in [8, 30, 49, 101, 256, 250] {
        let signal: Vec<f64> = (0..samples).map(|i| f64::from(i * i).sin()).collect();
        let window_s = f64::from(samples) / RATE_HZ;
        for direction in [RideDirection::Lateral, RideDirection::Vertical] {
            let found = sperling(&signal, RATE_HZ, window_s, direction).unwrap();
            let expected = defined(&signal, direction);
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{found} for {expected}, {samples}"
            );
        }
    }
}
