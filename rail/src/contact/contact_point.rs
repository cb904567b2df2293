//! The point at which rigid bodies touch.

use super::pair::Pair;
use super::silhouette::SilhouettePoint;

/// Contact point of a rigid wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactPoint {
    /// Depth of the wheel below the rail's surface when the tread datum is at the height of the rail's top, m.
    pub interpenetration_m: f64,
    /// Lateral position on the wheel from the tread datum, field side positive, m.
    pub wheel_y_m: f64,
    /// Depth on the wheel, m; the rolling radius is the wheel radius plus this depth.
    pub wheel_z_m: f64,
    /// Lateral position from the track centre, m.
    pub track_y_m: f64,
    /// `dz/dy` of both surfaces across the track: the tangent of the contact angle.
    pub slope: f64,
    /// Curvature of the rail minus that of the wheel, across the track, 1/m.
    pub curvature_per_m: f64,
}

/// Interpenetration of a wheel that is nowhere over the rail, m. It lies far out of contact.
const ABSENT_M: f64 = -0.05;

impl Pair {
    /// The contact point of a wheel that is nowhere over the rail.
    pub(super) fn absent(&self) -> ContactPoint {
        ContactPoint {
            interpenetration_m: ABSENT_M,
            wheel_y_m: self.tread_end_m(),
            wheel_z_m: 0.0,
            track_y_m: self.installation().datum_offset_m(),
            slope: 0.0,
            curvature_per_m: 1.0,
        }
    }

    /// One point of the silhouette as a contact point.
    pub(super) fn contact_point(&self, point: &SilhouettePoint) -> ContactPoint {
        let on_wheel = &self.wheel().points()[point.index];
        ContactPoint {
            interpenetration_m: point.interpenetration_m,
            wheel_y_m: on_wheel.y_m,
            wheel_z_m: on_wheel.z_m,
            track_y_m: point.track_y_m,
            slope: point.slope,
            curvature_per_m: point.curvature_per_m,
        }
    }
}

impl ContactPoint {
    /// Combines each quantity with that of `other`.
    pub(super) fn zip(&self, other: &Self, function: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            interpenetration_m: function(self.interpenetration_m, other.interpenetration_m),
            wheel_y_m: function(self.wheel_y_m, other.wheel_y_m),
            wheel_z_m: function(self.wheel_z_m, other.wheel_z_m),
            track_y_m: function(self.track_y_m, other.track_y_m),
            slope: function(self.slope, other.slope),
            curvature_per_m: function(self.curvature_per_m, other.curvature_per_m),
        }
    }
}
