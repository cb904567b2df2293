//! Ride of the car body: Sperling's index at points of its floor plan.

use dashpot_rail::indices::{RideDirection, sperling};
use dashpot_rail::vehicle::VehicleParameters;
use serde::Serialize;

/// Length of the windows of Sperling's index, s; the value depends on it.
pub const WINDOW_S: f64 = 5.0;

/// Ride at a point of the car body, at the height of its centre of gravity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RideIndices {
    /// The point.
    pub point: String,
    /// Length of the windows, s.
    pub window_s: f64,
    /// Windows that the means are of.
    pub windows: u64,
    /// Sperling's index to the side, 0.5 to 40 Hz, mean of the windows; none of a run shorter than one.
    pub sperling_lateral: Option<f64>,
    /// Sperling's index up and down.
    pub sperling_vertical: Option<f64>,
}

/// Sums up the ride of the first body, which is the car body, in its middle and over every other body.
#[derive(Debug, Clone)]
pub(super) struct Ride {
    points: Vec<Point>,
    window: usize,
    rate_hz: f64,
}

#[derive(Debug, Clone)]
struct Point {
    name: String,
    ahead_m: f64,
    /// The window that is being filled, lateral and vertical, m/s^2.
    accelerations: [Vec<f64>; 2],
    sums: [f64; 2],
    windows: u64,
}

impl Ride {
    pub fn new(vehicle: &VehicleParameters, step_s: f64) -> Self {
        let window = (WINDOW_S / step_s).round() as usize;
        let point = |name: String, ahead_m: f64| Point {
            name,
            ahead_m,
            accelerations: [Vec::with_capacity(window), Vec::with_capacity(window)],
            sums: [0.0; 2],
            windows: 0,
        };
        let mut points = Vec::new();
        if let Some((body, others)) = vehicle.bodies.split_first() {
            points.push(point(format!("{}, middle", body.name), 0.0));
            points.extend(others.iter().map(|other| {
                let name = format!("{}, over the {}", body.name, other.name);
                point(name, other.x_m - body.x_m)
            }));
        }
        Self {
            points,
            window,
            rate_hz: 1.0 / step_s,
        }
    }

    /// Adds the accelerations of the car body, in the order of its coordinates.
    pub fn add(&mut self, [lateral, vertical, _, pitch, yaw]: [f64; 5]) {
        for point in &mut self.points {
            let [to_side, down] = &mut point.accelerations;
            to_side.push(lateral + yaw * point.ahead_m);
            down.push(vertical - pitch * point.ahead_m);
            if down.len() < self.window {
                continue;
            }
            let directions = [RideDirection::Lateral, RideDirection::Vertical];
            let all = point.accelerations.iter_mut().zip(directions);
            for ((accelerations, direction), sum) in all.zip(&mut point.sums) {
                // A window is whole and finite: it has an index.
                *sum += sperling(accelerations, self.rate_hz, WINDOW_S, direction).unwrap_or(0.0);
                accelerations.clear();
            }
            point.windows += 1;
        }
    }

    pub fn indices(&self) -> Vec<RideIndices> {
        let of_point = |point: &Point| {
            let mean = |sum: f64| (point.windows > 0).then(|| sum / point.windows as f64);
            let [lateral, vertical] = point.sums.map(mean);
            RideIndices {
                point: point.name.clone(),
                window_s: WINDOW_S,
                windows: point.windows,
                sperling_lateral: lateral,
                sperling_vertical: vertical,
            }
        };
        self.points.iter().map(of_point).collect()
    }
}
