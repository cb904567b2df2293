//! Silhouette of a turned wheel over its rail: the depth of each point below the rail's surface.

use super::pair::Pair;
use crate::profile::ProfilePoint;

/// Position and attitude of a right wheel over its rail.
///
/// The fields are complete; none will be added.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WheelPose {
    /// Shift of the wheel from its centred position over the rail, field side positive, m.
    pub lateral_m: f64,
    /// Roll, field side down positive, rad.
    pub roll_rad: f64,
    /// Yaw, nose to the field side positive, rad.
    pub yaw_rad: f64,
}

/// One point of the wheel's silhouette over the rail.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct SilhouettePoint {
    /// Index of the point in the wheel's profile.
    pub index: usize,
    /// Lateral position from the track centre, m.
    pub track_y_m: f64,
    /// Depth of the wheel below the rail's surface when the tread datum is at the height of the rail's top, m.
    pub interpenetration_m: f64,
    /// `dz/dy` of the wheel's surface across the track.
    pub slope: f64,
    /// Curvature of the rail minus that of the wheel, 1/m.
    pub curvature_per_m: f64,
}

/// A wheel rotated by its roll and yaw, before it is shifted over the rail.
#[derive(Debug, Clone)]
pub struct TurnedWheel<'a> {
    pair: &'a Pair,
    points: Vec<TurnedPoint>,
}

/// One point of the silhouette of a turned wheel.
#[derive(Debug, Clone, Copy)]
pub(super) struct TurnedPoint {
    /// Lateral and vertical position relative to the tread datum of a centred wheel at the height of the rail's top, m.
    pub y: f64,
    pub z: f64,
    pub slope: f64,
    pub cos: f64,
}

/// Rotation of a wheel by its yaw and then its roll.
pub(super) struct Turn {
    roll: [f64; 2],
    yaw: [f64; 2],
    radius: f64,
}

impl Turn {
    pub fn new(roll_rad: f64, yaw_rad: f64, radius: f64) -> Self {
        let (roll, yaw) = (libm::sincos(roll_rad).into(), libm::sincos(yaw_rad).into());
        Self { roll, yaw, radius }
    }

    /// Where the circle of `point`, at which the wheel's surface has `slope`, touches the silhouette.
    pub fn point(&self, point: &ProfilePoint, slope: f64) -> TurnedPoint {
        let ([sin_roll, cos_roll], [sin_yaw, cos_yaw]) = (self.roll, self.yaw);
        let (tan_roll, tan_yaw) = (sin_roll / cos_roll, sin_yaw / cos_yaw);
        let r = self.radius + point.z_m;
        let sin_behind = slope * tan_yaw;
        let cos_behind = (1.0 - sin_behind * sin_behind).max(0.01).sqrt();
        let across = point.y_m * cos_yaw - r * sin_behind * sin_yaw;
        let down = r * cos_behind - self.radius;
        let unrolled_slope = slope / (cos_yaw * cos_behind);
        let slope = (unrolled_slope + tan_roll) / (1.0 - unrolled_slope * tan_roll);
        TurnedPoint {
            y: across * cos_roll - down * sin_roll,
            z: across * sin_roll + down * cos_roll,
            slope,
            cos: 1.0 / (1.0 + slope * slope).sqrt(),
        }
    }
}

impl Pair {
    /// Rotates the wheel by `roll_rad` and `yaw_rad`.
    ///
    /// The silhouette is that of the body of revolution, yawed and then rolled about the rail's direction, as seen
    /// along the rail. A circle of radius `r` and slope `t = dr/ds` touches it `r t tan(yaw)` behind the axle,
    /// `r t tan(yaw) sin(yaw)` inward and `r sqrt(1 - t^2 tan(yaw)^2)` below the axle. This is exact for this order of
    /// rotations.
    pub fn turned(&self, roll_rad: f64, yaw_rad: f64) -> TurnedWheel<'_> {
        let turn = Turn::new(roll_rad, yaw_rad, self.installation().wheel_radius_m);
        let points = self.wheel().points().iter().zip(&self.wheel_slopes);
        TurnedWheel {
            pair: self,
            points: points
                .map(|(point, slope)| turn.point(point, *slope))
                .collect(),
        }
    }

    /// Fills `silhouette` with the points of the wheel that are over the rail at `pose`.
    pub fn silhouette(&self, pose: &WheelPose, silhouette: &mut Vec<SilhouettePoint>) {
        self.turned(pose.roll_rad, pose.yaw_rad)
            .silhouette(pose.lateral_m, silhouette);
    }
}

impl<'a> TurnedWheel<'a> {
    /// The pair that the wheel belongs to.
    pub fn pair(&self) -> &'a Pair {
        self.pair
    }

    /// Fills `silhouette` with the points of the wheel that are over the rail at a lateral shift.
    pub fn silhouette(&self, lateral_m: f64, silhouette: &mut Vec<SilhouettePoint>) {
        silhouette.clear();
        let datum = self.pair.installation().datum_offset_m() + lateral_m;
        let mut rail = Cursor::new(self.pair);
        let on_wheel = self.pair.wheel().points();
        for (index, point) in self.points.iter().enumerate() {
            let track_y_m = datum + point.y;
            let Some((rail_z, rail_curvature)) = rail.at(track_y_m) else {
                continue;
            };
            let interpenetration_m = point.z - rail_z;
            silhouette.push(SilhouettePoint {
                index,
                track_y_m,
                interpenetration_m,
                slope: point.slope,
                curvature_per_m: rail_curvature - on_wheel[index].curvature_per_m,
            });
        }
    }
}

/// Interpolates a profile at mostly rising positions, without a search from the start.
pub(super) struct Cursor<'a> {
    points: &'a [ProfilePoint],
    slopes: &'a [f64],
    i: usize,
}

impl<'a> Cursor<'a> {
    /// A cursor on the rail of `pair`.
    pub fn new(pair: &'a Pair) -> Self {
        Self {
            points: pair.rail().points(),
            slopes: &pair.rail_slopes,
            i: 0,
        }
    }

    /// Depth (cubic Hermite interpolation) and curvature at `y`; `None` beyond the ends.
    pub fn at(&mut self, y: f64) -> Option<(f64, f64)> {
        let points = self.points;
        if !(points[0].y_m..=points[points.len() - 1].y_m).contains(&y) {
            return None;
        }
        while self.i > 0 && points[self.i].y_m > y {
            self.i -= 1;
        }
        while self.i + 2 < points.len() && points[self.i + 1].y_m < y {
            self.i += 1;
        }
        let (p, q) = (&points[self.i], &points[self.i + 1]);
        let h = q.y_m - p.y_m;
        let t = (y - p.y_m) / h;
        let (m0, m1) = (self.slopes[self.i] * h, self.slopes[self.i + 1] * h);
        let dz = q.z_m - p.z_m;
        let z = p.z_m + t * (m0 + t * (3.0 * dz - 2.0 * m0 - m1 + t * (m0 + m1 - 2.0 * dz)));
        Some((
            z,
            p.curvature_per_m + t * (q.curvature_per_m - p.curvature_per_m),
        ))
    }
}
