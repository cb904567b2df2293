//! Accelerations of bodies, and the unbalanced lateral acceleration of the track.

use serde::Serialize;

use super::sums::Statistics;

/// Accelerations of a body at its centre of gravity, across the track, as measured by an accelerometer: in a curve they
/// include the unbalanced acceleration.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyIndices {
    /// Name of the body.
    pub body: String,
    /// Root mean square of the lateral acceleration, m/s^2.
    pub lateral_rms_m_per_s2: f64,
    /// Maximum magnitude of the lateral acceleration, m/s^2.
    pub lateral_greatest_m_per_s2: f64,
    /// Root mean square of the vertical acceleration, m/s^2.
    pub vertical_rms_m_per_s2: f64,
    /// Maximum magnitude of the vertical acceleration, m/s^2.
    pub vertical_greatest_m_per_s2: f64,
}

/// Unbalanced lateral acceleration of the track layout under the first body, the car body: `V^2 k cos p - g sin p` with
/// the speed `V`, the curvature `k` and the cant angle `p`. It does not depend on the vehicle's motion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UnbalancedIndices {
    /// Root mean square, m/s^2.
    pub rms_m_per_s2: f64,
    /// Maximum magnitude, m/s^2.
    pub greatest_m_per_s2: f64,
}

/// Accumulated accelerations of a body.
#[derive(Debug, Clone)]
pub(super) struct BodySums {
    name: String,
    lateral: Statistics,
    vertical: Statistics,
}

impl BodySums {
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            lateral: Statistics::default(),
            vertical: Statistics::default(),
        }
    }

    /// Adds accelerations in the order of the coordinates: lateral, vertical, roll, pitch, yaw.
    pub fn add(&mut self, acceleration: [f64; 5]) {
        self.lateral.add(acceleration[0]);
        self.vertical.add(acceleration[1]);
    }

    pub fn indices(&self) -> BodyIndices {
        let (lateral, vertical) = (&self.lateral, &self.vertical);
        BodyIndices {
            body: self.name.clone(),
            lateral_rms_m_per_s2: lateral.rms(),
            lateral_greatest_m_per_s2: lateral.max_magnitude(),
            vertical_rms_m_per_s2: vertical.rms(),
            vertical_greatest_m_per_s2: vertical.max_magnitude(),
        }
    }
}

/// Returns the indices of the track's unbalanced acceleration.
pub(super) fn unbalanced(sums: &Statistics) -> UnbalancedIndices {
    UnbalancedIndices {
        rms_m_per_s2: sums.rms(),
        greatest_m_per_s2: sums.max_magnitude(),
    }
}
