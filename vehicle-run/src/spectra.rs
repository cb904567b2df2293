//! Power spectral densities of the ride point accelerations and of `Y/Q` on the leading wheelset.

use dashpot_rail::indices::{SpectrumError, Welch};
use dashpot_rail::vehicle::VehicleParameters;

use super::signals::{SIDES, ride, slug};

/// Length of a window, s; spectral lines are therefore 0.5 Hz apart.
pub const WINDOW_S: f64 = 2.0;

/// Highest frequency shown in figures, Hz.
pub const SHOWN_HZ: f64 = 40.0;

/// Power spectral density of one signal.
#[derive(Debug, Clone)]
pub struct Spectrum {
    signal: String,
    welch: Welch,
}

/// Returns the names of the signals with a spectrum: accelerations of the ride points, then `Y/Q` of the leading
/// wheelset.
pub fn signals(vehicle: &VehicleParameters) -> Vec<String> {
    let ride = ride(vehicle).into_iter();
    let leading = vehicle.wheelsets.first().into_iter();
    let derailment = leading.flat_map(|wheelset| {
        let name = slug(&wheelset.name);
        SIDES.map(|side| format!("{name}_{side}_derailment"))
    });
    ride.map(|signal| signal.name().to_owned())
        .chain(derailment)
        .collect()
}

impl Spectrum {
    /// Starts the spectrum of a signal sampled every `step_s` seconds.
    ///
    /// # Errors
    /// `step_s` is out of bounds.
    pub fn new(signal: String, step_s: f64) -> Result<Self, SpectrumError> {
        Ok(Self {
            signal,
            welch: Welch::new(1.0 / step_s, WINDOW_S)?,
        })
    }

    /// Name of the signal.
    pub fn signal(&self) -> &str {
        &self.signal
    }

    /// Name of the density: that of the signal, with its unit squared per Hz.
    pub fn name(&self) -> String {
        match self.signal.strip_suffix("_m_per_s2") {
            Some(stem) => format!("{stem}_m2_per_s4_per_hz"),
            None => format!("{}_per_hz", self.signal),
        }
    }

    /// Adds a sample.
    pub fn add(&mut self, value: f64) {
        self.welch.add(value);
    }

    /// Returns pairs of frequency (Hz) and density (signal unit squared per Hz), or an empty list if the run is shorter
    /// than a window.
    pub fn density(&self) -> Vec<[f64; 2]> {
        if self.welch.windows() == 0 {
            return Vec::new();
        }
        self.welch.density()
    }
}
