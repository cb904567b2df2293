//! Ride indices against published values and closed forms.

use std::f64::consts::PI;

use dashpot_rail::indices::{
    RideDirection, SpectrumError, Sperling, Weighting, WeightingFilter, mean_comfort,
    mean_comfort_of_windows, nadal_limit, prudhomme_limit_n, sperling, weighted_rms, welch,
    wheel_unloading,
};

const RATE_HZ: f64 = 500.0;

fn sine(amplitude: f64, frequency_hz: f64, seconds: f64) -> Vec<f64> {
    (0..(seconds * RATE_HZ) as usize)
        .map(|i| amplitude * (2.0 * PI * frequency_hz * i as f64 / RATE_HZ).sin())
        .collect()
}

/// Rows of numbers of a table with comments and a header.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines
        .map(|line| {
            line.split(',')
                .map(|field| field.parse().unwrap())
                .collect()
        })
        .collect()
}

#[test]
fn the_ride_index_of_a_line_equals_the_published_value() {
    let table = rows(include_str!("../../data/sperling_lines.csv"));
    assert_eq!(table.len(), 18);
    for row in table {
        let [frequency, amplitude, vertical, lateral] = row[..] else {
            panic!("{row:?}")
        };
        let signal = sine(amplitude, frequency, 10.0);
        for (direction, expected) in [
            (RideDirection::Vertical, vertical),
            (RideDirection::Lateral, lateral),
        ] {
            let found = sperling(&signal, RATE_HZ, 5.0, direction).unwrap();
            assert!(
                (found - expected).abs() < 1e-4,
                "{frequency} Hz: {found} for {expected}"
            );
        }
    }
}

/// The tenth powers of the lines add up. The mean and lines outside the band do not count.
#[test]
fn lines_add_up_by_their_tenth_powers() {
    let index = |signal: &[f64]| sperling(signal, RATE_HZ, 5.0, RideDirection::Vertical).unwrap();
    let (a, b) = (sine(0.3, 2.0, 5.0), sine(0.2, 6.0, 5.0));
    let outside = sine(3.0, 0.2, 5.0);
    let beyond = sine(2.0, 60.0, 5.0);
    let sum: Vec<f64> = (0..a.len())
        .map(|i| 1.7 + a[i] + b[i] + outside[i] + beyond[i])
        .collect();
    let expected = (index(&a).powi(10) + index(&b).powi(10)).powf(0.1);
    let found = index(&sum);
    assert!((found - expected).abs() < 1e-6, "{found} {expected}");
}

#[test]
fn weightings_have_the_published_gains() {
    let table = rows(include_str!("../../data/en12299_weighting_gains.csv"));
    assert!(table.len() > 10);
    for row in table {
        let [frequency, vertical, horizontal, _] = row[..] else {
            panic!("{row:?}")
        };
        for (weighting, expected) in [
            (Weighting::Vertical, vertical),
            (Weighting::Horizontal, horizontal),
        ] {
            let found = weighting.gain(frequency);
            assert!(
                (found - expected).abs() < 2e-5,
                "{frequency} Hz: {found} for {expected}"
            );
        }
    }
}

#[test]
fn the_comfort_of_sines_follows_from_their_weighted_amplitudes() {
    let (x, y, z) = (
        sine(0.0, 1.0, 60.0),
        sine(0.2, 1.0, 60.0),
        sine(0.5, 5.0, 60.0),
    );
    let comfort = mean_comfort([&x, &y, &z], RATE_HZ).unwrap();
    let rms = |amplitude: f64, gain: f64| amplitude * gain / 2.0_f64.sqrt();
    // Gains of the published table.
    let expected = 6.0 * rms(0.2, 1.01102).hypot(rms(0.5, 0.95703));
    assert!(
        (comfort / expected - 1.0).abs() < 1e-4,
        "{comfort} for {expected}"
    );
    let windows = weighted_rms(&z, RATE_HZ, Weighting::Vertical).unwrap();
    assert_eq!(windows.len(), 12);
}

/// The filter has the published gains within the error of the bilinear transform at 1 kHz.
#[test]
fn the_filter_has_the_published_gains() {
    const RATE_HZ: f64 = 1000.0;
    let table = rows(include_str!("../../data/en12299_weighting_gains.csv"));
    let mut compared = 0;
    for row in table {
        let [frequency, vertical, horizontal, _] = row[..] else {
            panic!("{row:?}")
        };
        if frequency > 40.0 {
            continue;
        }
        compared += 1;
        for (weighting, expected) in [
            (Weighting::Vertical, vertical),
            (Weighting::Horizontal, horizontal),
        ] {
            let mut filter = WeightingFilter::new(weighting, RATE_HZ).unwrap();
            // Finds the sine and cosine components over whole periods, after the filter (with its lowest corner at 0.4
            // Hz) has settled.
            let period = (RATE_HZ / frequency).round();
            let settled = 20_000_u32;
            let cycles = (40.0 * frequency).ceil();
            let measured = (cycles * period) as u32;
            let (mut sine, mut cosine) = (0.0, 0.0);
            for i in 0..settled + measured {
                let angle = 2.0 * PI * f64::from(i) / period;
                let out = filter.next(angle.sin());
                if i >= settled {
                    sine += 2.0 * out * angle.sin() / f64::from(measured);
                    cosine += 2.0 * out * angle.cos() / f64::from(measured);
                }
            }
            // The frequency differs slightly from the table's, so that a period is a whole number of samples.
            let gain = weighting.gain(RATE_HZ / period);
            assert!((gain / expected - 1.0).abs() < 0.05, "{frequency} Hz");
            let found = sine.hypot(cosine);
            assert!(
                (found / gain - 1.0).abs() < 5e-3,
                "{frequency} Hz: {found} for {gain}"
            );
        }
    }
    assert!(compared > 8, "{compared}");
}

/// A constant acceleration, as in a curve, is filtered out from the first sample on.
#[test]
fn a_constant_is_filtered_out() {
    for weighting in [Weighting::Vertical, Weighting::Horizontal] {
        let mut filter = WeightingFilter::new(weighting, 1000.0).unwrap();
        let max = (0..10_000).fold(0.0_f64, |max, _| max.max(filter.next(1.3).abs()));
        assert!(max < 1e-6, "{max}");
    }
    let error = WeightingFilter::new(Weighting::Vertical, 100.0).unwrap_err();
    assert_eq!(error.to_string(), "rate_hz: 100, allowed: 400 to 1000000");
}

/// The 95th percentile of 1 to 21 is 20; `6 sqrt(0 + 20^2 + 15^2)`.
#[test]
fn comfort_follows_from_the_percentiles_of_windows() {
    let rising: Vec<f64> = (1..=21).rev().map(f64::from).collect();
    let comfort = mean_comfort_of_windows([&[], &rising, &[15.0]]);
    assert!((comfort - 150.0).abs() < 1e-9, "{comfort}");
}

/// The 95th percentile of 12 windows is at position 0.95 * 11 = 10.45, counted from 0: `11^2 + 0.45 (12^2 - 11^2)`.
#[test]
fn percentiles_are_interpolated_between_windows() {
    let squares: Vec<f64> = (1..=12).map(|i| f64::from(i * i)).collect();
    let comfort = mean_comfort_of_windows([&squares, &[], &[]]);
    assert!((comfort - 6.0 * 131.35).abs() < 1e-9, "{comfort}");
}

/// The corrections at the edges of their parts are those of the upper part (GB/T 5599).
#[test]
fn corrections_of_the_ride_index_change_at_their_edges() {
    let (lateral, vertical) = (RideDirection::Lateral, RideDirection::Vertical);
    for (direction, frequency_hz, expected) in [
        (vertical, 5.89, 0.325 * 5.89 * 5.89),
        (vertical, 5.9, 400.0 / (5.9 * 5.9)),
        (vertical, 19.9, 400.0 / (19.9 * 19.9)),
        (vertical, 20.0, 1.0),
        (lateral, 5.39, 0.8 * 5.39 * 5.39),
        (lateral, 5.4, 650.0 / (5.4 * 5.4)),
        (lateral, 25.9, 650.0 / (25.9 * 25.9)),
        (lateral, 26.0, 1.0),
    ] {
        let found = direction.correction(frequency_hz);
        assert!(
            (found - expected).abs() < 1e-12,
            "{frequency_hz} Hz: {found} for {expected}"
        );
    }
}

/// By Parseval's theorem the integral is the variance, also for a signal at half the rate, whose line has no mirror
/// image.
#[test]
fn the_line_at_half_the_rate_counts_once() {
    let alternating: Vec<f64> = (0..4000)
        .map(|i| if i % 2 == 0 { 2.0 } else { -2.0 })
        .collect();
    let density = welch(&alternating, RATE_HZ, 1.0).unwrap();
    let variance: f64 = density.iter().map(|[_, density]| density).sum();
    assert!((variance - 4.0).abs() < 1e-9, "{variance}");
    assert_eq!(density[density.len() - 1][0], 0.5 * RATE_HZ);
}

#[test]
fn a_window_has_at_least_eight_samples() {
    assert_eq!(Sperling::new(100.0, 0.01).unwrap().samples(), 8);
    assert_eq!(Sperling::new(100.0, 0.25).unwrap().samples(), 25);
    assert!(Sperling::new(100.0, 0.0).is_err());
    assert!(WeightingFilter::new(Weighting::Vertical, 400.0).is_ok());
    assert!(WeightingFilter::new(Weighting::Vertical, 399.0).is_err());
}

/// Both ends of the band count, the next lines beyond them do not: `W = 3.57 (A^3 F/f)^0.1`.
#[test]
fn the_band_of_the_ride_index_includes_both_ends() {
    let index = |frequency_hz: f64| {
        // Windows of 10 s have lines 0.1 Hz apart.
        let signal = sine(0.4, frequency_hz, 10.0);
        sperling(&signal, RATE_HZ, 10.0, RideDirection::Vertical).unwrap()
    };
    let closed_form = |frequency_hz: f64, correction: f64| {
        3.57 * (0.4_f64.powi(3) * correction / frequency_hz).powf(0.1)
    };
    for (frequency_hz, expected) in [
        (0.5, closed_form(0.5, 0.325 * 0.25)),
        (40.0, closed_form(40.0, 1.0)),
    ] {
        let found = index(frequency_hz);
        assert!(
            (found - expected).abs() < 1e-9,
            "{frequency_hz} Hz: {found} for {expected}"
        );
    }
    // Only rounding errors remain in the band.
    for frequency_hz in [0.4, 40.1] {
        let found = index(frequency_hz);
        assert!(found < 1e-3, "{frequency_hz} Hz: {found}");
    }
}

/// Nadal's limit for a flange angle of 75 degrees and friction 0.5 is 1.13 (TCRP Report 71); Prud'homme's limit for an
/// axle load of 201 kN is 77 kN.
#[test]
fn limits_equal_the_published_values() {
    let limit = nadal_limit(75_f64.to_radians(), 0.5);
    assert!((limit - 1.13).abs() < 0.005, "{limit}");
    // Without friction the limit is the slope of the flange.
    assert!((nadal_limit(45_f64.to_radians(), 0.0) - 1.0).abs() < 1e-12);
    assert!((prudhomme_limit_n(201e3) - 77e3).abs() < 1e-6);
    assert_eq!(wheel_unloading(100e3, 40e3), 0.6);
}

/// White noise of variance `v` has the density `2 v/rate` at every frequency, and the integral of any density is the
/// variance.
#[test]
fn the_density_of_noise_is_flat_and_its_integral_the_variance() {
    // Lehmer generator, uniform between -1 and 1: variance 1/3.
    let mut seed = 1_u64;
    let noise: Vec<f64> = (0..200_000)
        .map(|_| {
            seed = seed * 48_271 % 2_147_483_647;
            2.0 * seed as f64 / 2_147_483_647.0 - 1.0
        })
        .collect();
    let density = welch(&noise, RATE_HZ, 2.0).unwrap();
    let variance: f64 = density.iter().map(|[_, density]| 0.5 * density).sum();
    assert!((variance * 3.0 - 1.0).abs() < 0.01, "{variance}");
    let expected = 2.0 / 3.0 / RATE_HZ;
    for band in density[10..490].chunks(80) {
        let mean = band.iter().map(|[_, density]| density).sum::<f64>() / band.len() as f64;
        assert!(
            (mean / expected - 1.0).abs() < 0.05,
            "{mean} for {expected}"
        );
    }
}

#[test]
fn invalid_signals_are_rejected() {
    let short = sperling(&[0.0; 100], RATE_HZ, 5.0, RideDirection::Lateral).unwrap_err();
    assert_eq!(
        short.to_string(),
        "100 samples, allowed: at least the 2500 samples of a window"
    );
    let mut signal = sine(1.0, 1.0, 5.0);
    signal[7] = f64::NAN;
    assert!(matches!(
        welch(&signal, RATE_HZ, 1.0),
        Err(SpectrumError::NotFinite { sample: 7, .. })
    ));
    let rate = welch(&signal, f64::NAN, 1.0).unwrap_err().to_string();
    assert!(
        rate.starts_with("rate_hz: NaN, allowed: 0.001 to"),
        "{rate}"
    );
}
