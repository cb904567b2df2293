//! A sensor: noise, resolution, lag and readings that do not come.

use dashpot_files::actuator::{DisplacementSensor, ForceSensor};
use fastrand::Rng;

/// Settings of a [`Sensor`], in the unit of what it measures. The default is a perfect sensor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SensorSettings {
    /// Standard deviation of the noise.
    pub noise: f64,
    /// Smallest difference between two readings; 0 for none.
    pub resolution: f64,
    /// Largest magnitude of a reading; 0 for no limit.
    pub range: f64,
    /// Time constant of the lag (s).
    pub lag_s: f64,
    /// Probability that a reading does not come.
    pub dropout: f64,
}

impl From<&DisplacementSensor> for SensorSettings {
    fn from(sensor: &DisplacementSensor) -> Self {
        Self {
            noise: sensor.noise_m,
            resolution: sensor.resolution_m,
            range: 0.0,
            lag_s: sensor.lag_s,
            dropout: sensor.dropout,
        }
    }
}

impl From<&ForceSensor> for SensorSettings {
    fn from(sensor: &ForceSensor) -> Self {
        Self {
            noise: sensor.noise_n,
            resolution: sensor.resolution_n,
            range: 0.0,
            lag_s: sensor.lag_s,
            dropout: sensor.dropout,
        }
    }
}

/// Normally distributed numbers.
#[derive(Clone, Debug)]
pub struct Noise(Rng);

impl Noise {
    /// A sequence that depends on the seed alone.
    pub fn new(seed: u64) -> Self {
        Self(Rng::with_seed(seed))
    }

    /// The next number, with mean 0 and standard deviation 1 (Box and Muller).
    pub fn normal(&mut self) -> f64 {
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.0.f64()));
        radius * libm::cos(std::f64::consts::TAU * self.0.f64())
    }

    /// True with a probability.
    pub fn happens(&mut self, probability: f64) -> bool {
        self.0.f64() < probability
    }
}

/// A sensor that is read once a tick.
///
/// ```
/// use dashpot_hybrid::{Noise, Sensor, SensorSettings};
///
/// let settings = SensorSettings { resolution: 0.5, ..SensorSettings::default() };
/// let mut sensor = Sensor::new(settings, 1e-3);
/// assert_eq!(sensor.read(1.3, &mut Noise::new(1)), Some(1.5));
/// ```
#[derive(Clone, Debug)]
pub struct Sensor {
    settings: SensorSettings,
    /// Share of the way to a new value in a tick.
    following: f64,
    followed: Option<f64>,
}

impl Sensor {
    /// A sensor that has not been read.
    pub fn new(settings: SensorSettings, step_s: f64) -> Self {
        let following = match settings.lag_s > 0.0 {
            true => 1.0 - libm::exp(-step_s / settings.lag_s),
            false => 1.0,
        };
        Self {
            settings,
            following,
            followed: None,
        }
    }

    /// Multiplies the noise of all later readings.
    pub fn amplify_noise(&mut self, factor: f64) {
        self.settings.noise *= factor;
    }

    /// Reads a value; `None` if the reading does not come.
    pub fn read(&mut self, value: f64, noise: &mut Noise) -> Option<f64> {
        let SensorSettings {
            noise: deviation,
            resolution,
            range,
            dropout,
            ..
        } = self.settings;
        let last = self.followed.unwrap_or(value);
        let followed = last + self.following * (value - last);
        self.followed = Some(followed);
        let mut reading = followed + deviation * noise.normal();
        if resolution > 0.0 {
            reading = libm::round(reading / resolution) * resolution;
        }
        if range > 0.0 {
            reading = reading.clamp(-range, range);
        }
        match noise.happens(dropout) {
            true => None,
            false => Some(reading),
        }
    }
}
