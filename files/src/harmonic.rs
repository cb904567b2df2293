//! Harmonic motion of a test bench.

use std::f64::consts::TAU;

/// Maximum amplitude of a harmonic motion (m).
pub const MAX_AMPLITUDE_M: f64 = 1.0;
/// Maximum frequency of a harmonic motion (Hz).
pub const MAX_FREQUENCY_HZ: f64 = 1000.0;

/// Harmonic displacement between the damper's ends, `x = A sin(2 pi f t)`, positive in extension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Amplitude A (m).
    pub amplitude_m: f64,
    /// Frequency f (Hz).
    pub frequency_hz: f64,
}

impl Harmonic {
    /// Nominal motion in Table 5 of the source paper: 24.875 mm at 0.64 Hz, peak velocity 0.1 m/s.
    pub const TABLE_5: Self = Self {
        amplitude_m: 24.875e-3,
        frequency_hz: 0.64,
    };

    /// Peak velocity `2 pi f A` (m/s).
    pub fn peak_velocity_m_per_s(&self) -> f64 {
        TAU * self.frequency_hz * self.amplitude_m
    }

    /// Checks amplitude and frequency.
    ///
    /// # Errors
    /// Returns an error if the amplitude or the frequency is out of range.
    pub fn check(&self) -> Result<(), HarmonicError> {
        let is_within = |value: f64, max: f64| value > 0.0 && value <= max;
        if !is_within(self.amplitude_m, MAX_AMPLITUDE_M) {
            return Err(HarmonicError::Amplitude(self.amplitude_m));
        }
        if !is_within(self.frequency_hz, MAX_FREQUENCY_HZ) {
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
    #[error("amplitude: {0}, allowed: above 0 and at most {MAX_AMPLITUDE_M} m")]
    Amplitude(f64),
    /// Frequency (Hz) out of range.
    #[error("frequency: {0}, allowed: above 0 and at most {MAX_FREQUENCY_HZ} Hz")]
    Frequency(f64),
}
