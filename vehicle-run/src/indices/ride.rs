//! Ride: Sperling's index and mean comfort at points of a vehicle.

use dashpot_rail::indices::{
    COMFORT_BAND_HZ, RideDirection, SPERLING_BAND_HZ, SpectrumError, Sperling, Weighting,
    WeightingFilter, mean_comfort_of_windows,
};
use dashpot_rail::vehicle::VehicleParameters;
use serde::Serialize;

use crate::Accelerometer;
use dashpot_files::case::Case;

/// Length of the windows, s: Sperling's index depends on it, mean comfort is defined by it.
pub const WINDOW_S: f64 = 5.0;

/// Why a run of a case has no index of ride.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoRide {
    /// It ends before the first window is full.
    #[error(
        "the run takes {duration_s} s, and an index of ride needs a whole window of {WINDOW_S} s"
    )]
    Short {
        /// Duration of the run, s.
        duration_s: f64,
    },
    /// The indices are not defined for its step.
    #[error("an index of ride at a step of {} us: {source}", 1e6 * step_s)]
    Step {
        /// Step of the run, s.
        step_s: f64,
        /// Why.
        source: SpectrumError,
    },
}

/// Whether a run of `case` that comes to its end has indices of ride.
///
/// # Errors
/// Why it has none.
pub fn check_ride(case: &Case) -> Result<(), NoRide> {
    let Case {
        step_s, duration_s, ..
    } = *case;
    let sperling =
        Sperling::new(1.0 / step_s, WINDOW_S).map_err(|source| NoRide::Step { step_s, source })?;
    if (duration_s / step_s).round() < sperling.samples() as f64 {
        return Err(NoRide::Short { duration_s });
    }
    Ok(())
}

/// Ride at a point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RideIndices {
    /// The point.
    pub point: String,
    /// Its place: x forward from the middle of the vehicle, y right, height above the rails' top, m.
    pub at_m: [f64; 3],
    /// Length of the windows, s.
    pub window_s: f64,
    /// Windows that the indices are of.
    pub windows: u64,
    /// Band of Sperling's index, Hz.
    pub sperling_band_hz: [f64; 2],
    /// Sperling's index to the side, mean of the windows; none of a run shorter than one.
    pub sperling_lateral: Option<f64>,
    /// Sperling's index up and down.
    pub sperling_vertical: Option<f64>,
    /// Corners of the band that mean comfort is limited to, Hz.
    pub comfort_band_hz: [f64; 2],
    /// Mean comfort of EN 12299 from the 95th percentiles of the windows, dimensionless; along the track nothing accelerates.
    pub mean_comfort: Option<f64>,
}

/// Sums up the ride at every point of a vehicle.
#[derive(Debug, Clone)]
pub(super) struct Ride {
    sperling: Sperling,
    points: Vec<Point>,
}

#[derive(Debug, Clone)]
struct Point {
    accelerometer: Accelerometer,
    /// Lateral and vertical.
    across: [Direction; 2],
    windows: u64,
}

#[derive(Debug, Clone)]
struct Direction {
    direction: RideDirection,
    /// The window that is being filled, m/s^2.
    window: Vec<f64>,
    /// Sum of Sperling's indices of the windows.
    sperling: f64,
    filter: WeightingFilter,
    /// Sum of squares of the weighted accelerations of the window.
    square: f64,
    /// Weighted root mean squares of the windows, m/s^2.
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
    /// At the points of a vehicle.
    ///
    /// # Errors
    /// A step that the indices are not defined for.
    pub fn new(vehicle: &VehicleParameters, step_s: f64) -> Result<Self, SpectrumError> {
        let rate_hz = 1.0 / step_s;
        let sperling = Sperling::new(rate_hz, WINDOW_S)?;
        let samples = sperling.samples();
        let point = |accelerometer| {
            Ok(Point {
                accelerometer,
                across: [
                    Direction::new(RideDirection::Lateral, samples, rate_hz)?,
                    Direction::new(RideDirection::Vertical, samples, rate_hz)?,
                ],
                windows: 0,
            })
        };
        let points = Accelerometer::all(vehicle).into_iter().map(point);
        Ok(Self {
            points: points.collect::<Result<_, _>>()?,
            sperling,
        })
    }

    /// Adds the accelerations of the bodies, in the order of their coordinates.
    pub fn add(&mut self, of_body: impl Fn(usize) -> [f64; 5]) {
        for point in &mut self.points {
            let acceleration = point.accelerometer.acceleration(&of_body);
            for (direction, value) in point.across.iter_mut().zip(acceleration) {
                direction.add(value);
            }
            if point.across[0].window.len() < self.sperling.samples() {
                continue;
            }
            for direction in &mut point.across {
                direction.end_window(&mut self.sperling);
            }
            point.windows += 1;
        }
    }

    pub fn indices(&self) -> Vec<RideIndices> {
        let of_point = |point: &Point| {
            let is_any = point.windows > 0;
            let [lateral, vertical] = &point.across;
            let mean = |sum: f64| is_any.then(|| sum / point.windows as f64);
            let along = [];
            let comfort = [&along[..], &lateral.weighted, &vertical.weighted];
            RideIndices {
                point: point.accelerometer.name().to_owned(),
                at_m: point.accelerometer.at_m(),
                window_s: WINDOW_S,
                windows: point.windows,
                sperling_band_hz: SPERLING_BAND_HZ,
                sperling_lateral: mean(lateral.sperling),
                sperling_vertical: mean(vertical.sperling),
                comfort_band_hz: COMFORT_BAND_HZ,
                mean_comfort: is_any.then(|| mean_comfort_of_windows(comfort)),
            }
        };
        self.points.iter().map(of_point).collect()
    }
}
