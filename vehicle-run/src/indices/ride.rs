//! Ride indices at points of a vehicle: Sperling's index and mean comfort.

use dashpot_rail::indices::{
    COMFORT_BAND_HZ, RideDirection, SPERLING_BAND_HZ, SpectrumError, Sperling, Weighting,
    WeightingFilter, mean_comfort_of_windows,
};
use dashpot_rail::vehicle::VehicleParameters;
use serde::Serialize;

use crate::Accelerometer;
use dashpot_files::case::Case;

/// Length of a window, s. Sperling's index depends on this length, and the definition of mean comfort requires it.
pub const WINDOW_S: f64 = 5.0;

/// Reason why a run has no ride indices.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RideError {
    /// The run is shorter than one window.
    #[error("the run takes {duration_s} s, but a ride index needs a whole window of {WINDOW_S} s")]
    Short {
        /// Duration of the run, s.
        duration_s: f64,
    },
    /// The ride indices are not defined for this step size.
    #[error("ride index at a step of {} us: {source}", 1e6 * step_s)]
    Step {
        /// Step size of the run, s.
        step_s: f64,
        /// Reason.
        source: SpectrumError,
    },
}

/// Checks that a completed run of `case` has ride indices.
///
/// # Errors
/// The run is too short, or its step size is not supported.
pub fn check_ride(case: &Case) -> Result<(), RideError> {
    let Case {
        step_s, duration_s, ..
    } = *case;
    let sperling = Sperling::new(1.0 / step_s, WINDOW_S)
        .map_err(|source| RideError::Step { step_s, source })?;
    if (duration_s / step_s).round() < sperling.samples() as f64 {
        return Err(RideError::Short { duration_s });
    }
    Ok(())
}

/// Ride indices at a point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RideIndices {
    /// Name of the point.
    pub point: String,
    /// Coordinates, m: x forward from the middle of the vehicle, y to the right, height above the top of the rails.
    pub at_m: [f64; 3],
    /// Length of a window, s.
    pub window_s: f64,
    /// Number of windows.
    pub windows: u64,
    /// Frequency band of Sperling's index, Hz.
    pub sperling_band_hz: [f64; 2],
    /// Lateral Sperling index, mean of the windows; `None` if the run is shorter than one window.
    pub sperling_lateral: Option<f64>,
    /// Vertical Sperling index, mean of the windows; `None` if the run is shorter than one window.
    pub sperling_vertical: Option<f64>,
    /// Corner frequencies of the band of mean comfort, Hz.
    pub comfort_band_hz: [f64; 2],
    /// Mean comfort `N_MV` of EN 12299 from the 95th percentiles of the windows, dimensionless. The longitudinal
    /// acceleration is taken as zero.
    pub mean_comfort: Option<f64>,
}

/// Accumulates the ride indices at every point of a vehicle.
#[derive(Debug, Clone)]
pub(super) struct Ride {
    sperling: Sperling,
    points: Vec<Point>,
}

#[derive(Debug, Clone)]
struct Point {
    accelerometer: Accelerometer,
    lateral: Direction,
    vertical: Direction,
    windows: u64,
}

#[derive(Debug, Clone)]
struct Direction {
    direction: RideDirection,
    /// Accelerations of the current window, m/s^2.
    window: Vec<f64>,
    /// Sum of the Sperling indices of all complete windows.
    sperling: f64,
    filter: WeightingFilter,
    /// Sum of the squared weighted accelerations of the current window.
    square: f64,
    /// Weighted root mean square of each complete window, m/s^2.
    weighted: Vec<f64>,
}

impl Direction {
    fn new(direction: RideDirection, samples: usize, rate_hz: f64) -> Result<Self, SpectrumError> {
        let weighting = match direction {
            RideDirection::Lateral => Weighting::Horizontal,
            RideDirection::Vertical => Weighting::Vertical,
        };
        Ok(Self {
            direction,
            window: Vec::with_capacity(samples),
            sperling: 0.0,
            filter: WeightingFilter::new(weighting, rate_hz)?,
            square: 0.0,
            weighted: Vec::new(),
        })
    }

    fn add(&mut self, acceleration: f64) {
        self.window.push(acceleration);
        let weighted = self.filter.next(acceleration);
        self.square += weighted * weighted;
    }

    fn end_window(&mut self, sperling: &mut Sperling) {
        self.sperling += sperling.of_window(&self.window, self.direction);
        let mean_square = self.square / self.window.len() as f64;
        self.weighted.push(mean_square.sqrt());
        self.square = 0.0;
        self.window.clear();
    }
}

impl Ride {
    /// Starts the ride indices at the points of a vehicle.
    ///
    /// # Errors
    /// The indices are not defined for this step size.
    pub fn new(vehicle: &VehicleParameters, step_s: f64) -> Result<Self, SpectrumError> {
        let rate_hz = 1.0 / step_s;
        let sperling = Sperling::new(rate_hz, WINDOW_S)?;
        let samples = sperling.samples();
        let point = |accelerometer| {
            Ok(Point {
                accelerometer,
                lateral: Direction::new(RideDirection::Lateral, samples, rate_hz)?,
                vertical: Direction::new(RideDirection::Vertical, samples, rate_hz)?,
                windows: 0,
            })
        };
        let points = Accelerometer::all(vehicle).into_iter().map(point);
        Ok(Self {
            points: points.collect::<Result<_, _>>()?,
            sperling,
        })
    }

    /// Adds a tick. `body_acceleration` returns the accelerations of a body, in the order of its coordinates.
    pub fn add(&mut self, body_acceleration: impl Fn(usize) -> [f64; 5]) {
        for point in &mut self.points {
            let [lateral, vertical] = point.accelerometer.acceleration(&body_acceleration);
            point.lateral.add(lateral);
            point.vertical.add(vertical);
            if point.lateral.window.len() < self.sperling.samples() {
                continue;
            }
            point.lateral.end_window(&mut self.sperling);
            point.vertical.end_window(&mut self.sperling);
            point.windows += 1;
        }
    }

    pub fn indices(&self) -> Vec<RideIndices> {
        let point_indices = |point: &Point| {
            let has_windows = point.windows > 0;
            let (lateral, vertical) = (&point.lateral, &point.vertical);
            let mean = |sum: f64| has_windows.then(|| sum / point.windows as f64);
            let longitudinal = [];
            let comfort = [&longitudinal[..], &lateral.weighted, &vertical.weighted];
            RideIndices {
                point: point.accelerometer.name().to_owned(),
                at_m: point.accelerometer.at_m(),
                window_s: WINDOW_S,
                windows: point.windows,
                sperling_band_hz: SPERLING_BAND_HZ,
                sperling_lateral: mean(lateral.sperling),
                sperling_vertical: mean(vertical.sperling),
                comfort_band_hz: COMFORT_BAND_HZ,
                mean_comfort: has_windows.then(|| mean_comfort_of_windows(comfort)),
            }
        };
        self.points.iter().map(point_indices).collect()
    }
}
