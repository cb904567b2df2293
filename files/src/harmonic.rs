//! Harmonic motions of a test bench.

use std::f64::consts::TAU;

/// Largest amplitude of a harmonic motion (m).
pub const LARGEST_AMPLITUDE_M: f64 = 1.0;
/// Highest frequency of a harmonic motion (Hz).
pub const HIGHEST_FREQUENCY_HZ: f64 = 1000.0;

/// A harmonic motion `x = A sin(2 pi f t)` of the seats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Amplitude A (m).
    pub amplitude_m: f64,
    /// Frequency f (Hz).
    pub frequency_hz: f64,
}

impl Harmonic {
    /// Nominal motion of the source paper's Table 5: 24.875 mm at 0.64 Hz, 0.1 m/s.
    pub const TABLE_5: Self = Self {
        amplitude_m: 24.875e-3,
        frequency_hz: 0.64,
    };

    /// Peak velocity `2 pi f A` (m/s).
    pub fn peak_velocity_m_per_s(&self) -> f64 {
        TAU * self.frequency_hz * self.amplitude_m
    }

    /// Whether a bench can make it.
    ///
    /// # Errors
    /// An amplitude or a frequency outside its range.
    pub fn check(&self) -> Result<(), HarmonicError> {
        let is_within = |value: f64, most: f64| value > 0.0 && value <= most;
        if !is_within(self.amplitude_m, LARGEST_AMPLITUDE_M) {
            return Err(HarmonicError::Amplitude(self.amplitude_m));
        }
        if !is_within(self.frequency_hz, HIGHEST_FREQUENCY_HZ) {
            return Err(HarmonicError::Frequency(self.frequency_hz));
        }
        Ok(())
    }
}

/// Invalid harmonic motion.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HarmonicError {
    /// Amplitude (m) out of range.
    #[error("amplitude: {0}, allowed: above 0 and at most {LARGEST_AMPLITUDE_M} m")]
    Amplitude(f64),
    /// Frequency (Hz) out of range.
    #[error("frequency: {0}, allowed: above 0 and at most {HIGHEST_FREQUENCY_HZ} Hz")]
    Frequency(f64),
}
