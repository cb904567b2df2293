//! Power spectral densities of a run: of the accelerations at its ride points and of `Y/Q` of the leading wheels.

use dashpot_rail::indices::{SpectrumError, Welch};
use dashpot_rail::vehicle::VehicleParameters;

use super::signals::{SIDES, of_ride, slug};

/// Length of the windows, s: lines are 0.5 Hz apart.
pub const WINDOW_S: f64 = 2.0;

/// Highest frequency that figures show, Hz.
pub const SHOWN_HZ: f64 = 40.0;

/// Density of a signal.
#[derive(Debug, Clone)]
pub struct Spectrum {
    signal: String,
    welch: Welch,
}

/// Names of the signals that densities are of: accelerations of the ride points, then `Y/Q` of the first wheelset's wheels.
pub fn signals(vehicle: &VehicleParameters) -> Vec<String> {
    let ride = of_ride(vehicle).into_iter();
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
    /// Of a signal, by its name, sampled every `step_s`.
    ///
    /// # Errors
    /// A step out of bounds.
    pub fn new(signal: String, step_s: f64) -> Result<Self, SpectrumError> {
        Ok(Self {
            signal,
            welch: Welch::new(1.0 / step_s, WINDOW_S)?,
        })
    }

    /// The signal.
    pub fn signal(&self) -> &str {
        &self.signal
    }

    /// What the density is called: the signal with the unit squared per Hz.
    pub fn name(&self) -> String {
        match self.signal.strip_suffix("_m_per_s2") {
            Some(what) => format!("{what}_m2_per_s4_per_hz"),
            None => format!("{}_per_hz", self.signal),
        }
    }

    /// Adds a number.
    pub fn add(&mut self, value: f64) {
        self.welch.add(value);
    }

    /// Frequency, Hz, and density, the signal's unit squared per Hz; nothing of a run shorter than a window.
    pub fn density(&self) -> Vec<[f64; 2]> {
        if self.welch.windows() == 0 {
            return Vec::new();
        }
        self.welch.density()
    }
}
