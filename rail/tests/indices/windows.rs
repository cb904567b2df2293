//! Densities of signals in windows, against closed forms.

use std::f64::consts::TAU;

use dashpot_rail::indices::{Welch, welch};

const RATE_HZ: f64 = 500.0;

/// With the Hann window, one period per window has the lines `-1/4`, `1/4` and `-1/8` of the number of samples. All but
/// the first have a mirror image.
#[test]
fn one_period_per_window_has_three_lines() {
    let period = |i: i32| (TAU * f64::from(i) / RATE_HZ).cos();
    let signal: Vec<f64> = (0..1500).map(period).collect();
    let density = welch(&signal, RATE_HZ, 1.0).unwrap();
    let expected = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 12.0, 0.0, 0.0];
    for (line, expected) in expected.into_iter().enumerate() {
        let [frequency_hz, found] = density[line];
        assert_eq!(frequency_hz, line as f64);
        assert!((found - expected).abs() < 1e-12, "{line}: {found}");
    }
}

#[test]
fn a_constant_has_no_density() {
    let density = welch(&[7.0; 1500], RATE_HZ, 1.0).unwrap();
    assert!(density.iter().all(|[_, density]| *density < 1e-24));
}

#[test]
fn windows_overlap_by_half() {
    let mut welch = Welch::new(RATE_HZ, 1.0).unwrap();
    for (samples, windows) in [(499, 0), (500, 1), (749, 1), (750, 2), (1000, 3)] {
        let mut welch = welch.clone();
        (0..samples).for_each(|_| welch.add(1.0));
        assert_eq!(welch.windows(), windows, "{samples} samples");
    }
    welch.add(1.0);
    assert_eq!(welch.windows(), 0);
}
