//! Frequency weightings of EN 12299.

use std::f64::consts::PI;

/// Frequency weighting of an acceleration (EN 12299, ISO 2631-4): band limits and a second-order weighting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Weighting {
    /// `Wb`: vertical.
    Vertical,
    /// `Wd`: lateral and longitudinal.
    Horizontal,
}

/// Corner frequencies of the band limits, Hz.
pub const COMFORT_BAND_HZ: [f64; 2] = [0.4, 100.0];
/// Quality factor of both band limits.
const BAND_QUALITY: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// A factor of the transfer function: quadratic polynomials in `s`, constant term first, and the corner frequency.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    pub corner_hz: f64,
    pub numerator: [f64; 3],
    pub denominator: [f64; 3],
}

/// Angular frequency, rad/s.
fn angular(frequency_hz: f64) -> f64 {
    2.0 * PI * frequency_hz
}

/// `s^2 + w/q s + w^2` with `w = 2 pi f`.
fn quadratic(corner_hz: f64, quality: f64) -> [f64; 3] {
    let w = angular(corner_hz);
    [w * w, w / quality, 1.0]
}

/// Squared magnitude of a polynomial at `s = i omega`.
fn square(polynomial: &[f64; 3], omega: f64) -> f64 {
    let [constant, linear, quadratic] = polynomial;
    (constant - quadratic * omega * omega).powi(2) + (linear * omega).powi(2)
}

impl Weighting {
    /// Factors of the transfer function.
    pub(super) fn sections(self) -> Vec<Section> {
        let [low, high] = COMFORT_BAND_HZ;
        // The weighting is (s + w3)/w3 divided by the quadratic at f4; the vertical one also has a step from f5 to f6.
        let (f3, f4, q4) = match self {
            Self::Vertical => (16.0, 16.0, 0.63),
            Self::Horizontal => (2.0, 2.0, 0.63),
        };
        let (w_high, w4) = (angular(high), angular(f4));
        let mut sections = vec![
            Section {
                corner_hz: low,
                numerator: [0.0, 0.0, 1.0],
                denominator: quadratic(low, BAND_QUALITY),
            },
            Section {
                corner_hz: high,
                numerator: [w_high * w_high, 0.0, 0.0],
                denominator: quadratic(high, BAND_QUALITY),
            },
            Section {
                corner_hz: f4,
                numerator: [w4 * w4, w4 * w4 / angular(f3), 0.0],
                denominator: quadratic(f4, q4),
            },
        ];
        if self == Self::Vertical {
            const FACTOR: f64 = 0.4;
            let (f5, q5, f6, q6) = (2.5, 0.8, 4.0, 0.8);
            let scale = FACTOR * (f6 / f5) * (f6 / f5);
            sections.push(Section {
                corner_hz: f6,
                numerator: quadratic(f5, q5).map(|number| scale * number),
                denominator: quadratic(f6, q6),
            });
        }
        sections
    }

    /// Returns the magnitude of the weighting at a frequency.
    ///
    /// ```
    /// use dashpot_rail::indices::Weighting;
    /// assert!((Weighting::Vertical.gain(8.0) - 1.05593).abs() < 1e-4);
    /// assert!((Weighting::Horizontal.gain(1.0) - 1.01102).abs() < 1e-4);
    /// ```
    pub fn gain(self, frequency_hz: f64) -> f64 {
        let omega = angular(frequency_hz);
        let gain = |section: &Section| {
            let numerator = square(&section.numerator, omega);
            (numerator / square(&section.denominator, omega)).sqrt()
        };
        self.sections().iter().map(gain).product()
    }
}
