//! Readings of accelerometers over a ride.

use super::error::SensorsError;
use super::limits::{MIN_DURATION_S, MIN_RATE_HZ};

/// Longer recordings are evaluated in equal pieces of at most this duration (s).
const MAX_PIECE_S: f64 = 60.0;
/// Largest deviation of a step from the usual one, as a share of it.
const MAX_UNEVEN: f64 = 0.2;

/// Direction in which an accelerometer measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Positive to the right.
    Lateral,
    /// Positive downward.
    Vertical,
}

/// Readings of one recording.
#[derive(Debug, Clone)]
pub struct Readings {
    /// Name of the recording, for messages.
    pub(super) name: String,
    pub(super) sensors: Vec<Sensor>,
    pub(super) has_gravity: bool,
    duration_s: f64,
}

/// Readings of one accelerometer (m/s^2). A lateral one reads less by `g sin(roll)`, unless the readings are without
/// gravity.
#[derive(Debug, Clone)]
pub(super) struct Sensor {
    /// Ride point of the vehicle file.
    pub point: String,
    pub axis: Axis,
    pub values: Vec<f64>,
}

impl Sensor {
    pub fn name(&self) -> String {
        let axis = match self.axis {
            Axis::Lateral => "lateral",
            Axis::Vertical => "vertical",
        };
        format!("{}, {axis}", self.point)
    }
}

impl Readings {
    /// Takes the readings (m/s^2) of sensors at equally spaced times (s). A sensor is the name of a ride point of the
    /// vehicle and an axis.
    ///
    /// # Errors
    /// The times are not equally spaced, the rate is below 99 Hz, the duration below 10 s, a reading is not finite, or
    /// a sensor always reads the same.
    pub fn new(
        name: &str,
        times_s: &[f64],
        sensors: Vec<(String, Axis, Vec<f64>)>,
    ) -> Result<Self, SensorsError> {
        let recording = || name.to_owned();
        let (first, last) = times_s.first().zip(times_s.last()).unwrap_or((&0.0, &0.0));
        let step_s = (last - first) / times_s.len().saturating_sub(1).max(1) as f64;
        let duration_s = step_s * times_s.len() as f64;
        if !(MIN_DURATION_S..).contains(&duration_s) {
            return Err(SensorsError::Short {
                recording: recording(),
                duration_s,
            });
        }
        let is_uneven = |pair: &&[f64]| ((pair[1] - pair[0]) / step_s - 1.0).abs() > MAX_UNEVEN;
        if let Some(pair) = times_s.windows(2).find(is_uneven) {
            return Err(SensorsError::Steps {
                recording: recording(),
                time_s: pair[0],
                step_s: pair[1] - pair[0],
                usual_s: step_s,
            });
        }
        if 1.0 / step_s < MIN_RATE_HZ {
            return Err(SensorsError::Rate {
                recording: recording(),
                rate_hz: 1.0 / step_s,
            });
        }
        let sensors = sensors.into_iter().map(|(point, axis, values)| Sensor {
            point,
            axis,
            values,
        });
        let sensors: Vec<Sensor> = sensors.collect();
        for sensor in &sensors {
            let mut rows = times_s
                .iter()
                .zip(sensor.values.iter().chain(std::iter::repeat(&f64::NAN)));
            if let Some((time_s, _)) = rows.find(|(_, value)| !value.is_finite()) {
                return Err(SensorsError::Missing {
                    recording: recording(),
                    sensor: sensor.name(),
                    time_s: *time_s,
                });
            }
            if let Some(value) = sensor
                .values
                .first()
                .filter(|first| sensor.values.iter().all(|value| value == *first))
            {
                return Err(SensorsError::Dead {
                    recording: recording(),
                    sensor: sensor.name(),
                    value: *value,
                });
            }
        }
        Ok(Self {
            name: recording(),
            sensors,
            has_gravity: true,
            duration_s,
        })
    }

    /// Takes the lateral readings as accelerations across the track, without the gravity that an accelerometer reads
    /// when its body rolls: those of a simulation.
    #[must_use]
    pub fn without_gravity(mut self) -> Self {
        self.has_gravity = false;
        self
    }

    /// Divides the recording into pieces that are evaluated on their own. Returns their duration (s) and, for each
    /// piece, the values of each sensor.
    pub(super) fn pieces(&self) -> impl Iterator<Item = (f64, Vec<&[f64]>)> {
        let rows = self.sensors.first().map_or(0, |sensor| sensor.values.len());
        let count = (self.duration_s / MAX_PIECE_S).ceil().max(1.0) as usize;
        let length = rows / count;
        let duration_s = self.duration_s * length as f64 / rows.max(1) as f64;
        (0..count).map(move |piece| {
            let range = piece * length..(piece + 1) * length;
            let values = self
                .sensors
                .iter()
                .map(|sensor| sensor.values.get(range.clone()).unwrap_or_default());
            (duration_s, values.collect())
        })
    }
}
