//! Low-pass filter of wheel forces.

use std::f64::consts::PI;

use dashpot_rail::indices::LowPass;

#[test]
fn a_constant_passes_from_the_first_sample() {
    let mut filter = LowPass::new(20.0, 1000.0);
    for _ in 0..100 {
        assert!((filter.next(-3.0) + 3.0).abs() < 1e-12);
    }
}

/// The gain is `1/sqrt(1 + (f/20)^8)`; the bilinear transform shifts 40 Hz by 0.5 %.
#[test]
fn an_octave_above_the_corner_a_sixteenth_is_left() {
    let mut filter = LowPass::new(20.0, 1000.0);
    let sine = |i: i32| (2.0 * PI * 40.0 * f64::from(i) / 1000.0).sin();
    let filtered: Vec<f64> = (0..5000).map(|i| filter.next(sine(i))).collect();
    let peak = filtered[1000..].iter().copied().fold(0.0, f64::max);
    assert!(
        (peak / (1.0 + 256.0_f64).sqrt().recip() - 1.0).abs() < 0.03,
        "{peak}"
    );
}
