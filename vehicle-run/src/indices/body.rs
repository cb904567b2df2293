//! Accelerations of bodies, and what the cant leaves of the centripetal one.

use serde::Serialize;

use super::sums::Spread;

/// Accelerations of a body at its centre of gravity, across the track, as an accelerometer has them: in a curve with what the cant leaves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyIndices {
    /// Name.
    pub body: String,
    /// Root mean square of the lateral acceleration, m/s^2.
    pub lateral_rms_m_per_s2: f64,
    /// Greatest magnitude of the lateral acceleration, m/s^2.
    pub lateral_greatest_m_per_s2: f64,
    /// Root mean square of the vertical acceleration, m/s^2.
    pub vertical_rms_m_per_s2: f64,
    /// Greatest magnitude of the vertical acceleration, m/s^2.
    pub vertical_greatest_m_per_s2: f64,
}

/// Unbalanced lateral acceleration of the track's layout under the first body, which is that of the car: `V^2 k cos p - g sin p` with the
/// curvature `k` and the cant angle `p`, whatever the vehicle does.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UnbalancedIndices {
    /// Root mean square, m/s^2.
    pub rms_m_per_s2: f64,
    /// Greatest magnitude, m/s^2.
    pub greatest_m_per_s2: f64,
}

/// Sums of a body.
#[derive(Debug, Clone)]
pub(super) struct BodySums {
    name: String,
    across: [Spread; 2],
}

impl BodySums {
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            across: [Spread::default(); 2],
        }
    }

    /// Adds an acceleration in the order of the coordinates.
    pub fn add(&mut self, acceleration: [f64; 5]) {
        for (spread, value) in self.across.iter_mut().zip(acceleration) {
            spread.add(value);
        }
    }

    pub fn indices(&self) -> BodyIndices {
        let [lateral, vertical] = &self.across;
        BodyIndices {
            body: self.name.clone(),
            lateral_rms_m_per_s2: lateral.rms(),
            lateral_greatest_m_per_s2: lateral.greatest(),
            vertical_rms_m_per_s2: vertical.rms(),
            vertical_greatest_m_per_s2: vertical.greatest(),
        }
    }
}

/// Those of the sums of the track's acceleration.
pub(super) fn unbalanced(sums: &Spread) -> UnbalancedIndices {
    UnbalancedIndices {
        rms_m_per_s2: sums.rms(),
        greatest_m_per_s2: sums.greatest(),
    }
}
