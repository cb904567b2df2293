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
    /// Interpenetration measured along the normal, `integral of cos(angle) d(interpenetration)` from the first point of
    /// the wheel, m. It ranks points by how close they are to contact.
    pub normal_height_m: f64,
    /// `dz/dy` of the wheel's surface across the track.
    pub slope: f64,
    /// Curvature of the rail minus that of the wheel, 1/m.
    pub curvature_per_m: f64,
}

/// A wheel rotated by its roll and yaw, before it is shifted over the rail.
#[derive(Debug, Clone)]
pub struct TurnedWheel<'a> {
    pair: &'a Pair,
    pub(super) roll_rad: f64,
    points: Vec<TurnedPoint>,
}

/// One point of the silhouette of a turned wheel.
#[derive(Debug, Clone, Copy)]
struct TurnedPoint {
    /// Lateral and vertical position relative to the tread datum of a centred wheel at the height of the rail's top, m.
    y: f64,
    z: f64,
    slope: f64,
    cos: f64,
}

impl Pair {
    /// Rotates the wheel by `roll_rad` and `yaw_rad`.
    ///
    /// The silhouette is that of the body of revolution, yawed and then rolled about the rail's direction, as seen
    /// along the rail. A circle of radius `r` and slope `t = dr/ds` touches it `r t tan(yaw)` behind the axle,
    /// `r t tan(yaw) sin(yaw)` inward and `r sqrt(1 - t^2 tan(yaw)^2)` below the axle. This is exact for this order of
    /// rotations.
    pub fn turned(&self, roll_rad: f64, yaw_rad: f64) -> TurnedWheel<'_> {
        let (sin_roll, cos_roll) = roll_rad.sin_cos();
        let (sin_yaw, cos_yaw) = yaw_rad.sin_cos();
        let radius = self.installation().wheel_radius_m;
        let (tan_roll, tan_yaw) = (sin_roll / cos_roll, sin_yaw / cos_yaw);
        let turn = |(point, slope): (&ProfilePoint, &f64)| {
            let r = radius + point.z_m;
            let sin_behind = slope * tan_yaw;
            let cos_behind = (1.0 - sin_behind * sin_behind).max(0.01).sqrt();
            let across = point.y_m * cos_yaw - r * sin_behind * sin_yaw;
            let down = r * cos_behind - radius;
            let unrolled_slope = slope / (cos_yaw * cos_behind);
            let slope = (unrolled_slope + tan_roll) / (1.0 - unrolled_slope * tan_roll);
            TurnedPoint {
                y: across * cos_roll - down * sin_roll,
                z: across * sin_roll + down * cos_roll,
                slope,
                cos: 1.0 / (1.0 + slope * slope).sqrt(),
            }
        };
        let points = self.wheel().points().iter().zip(&self.wheel_slopes);
        TurnedWheel {
            pair: self,
            roll_rad,
            points: points.map(turn).collect(),
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
        let mut rail = Cursor {
            points: self.pair.rail().points(),
            slopes: &self.pair.rail_slopes,
            i: 0,
        };
        let on_wheel = self.pair.wheel().points();
        let (mut height, mut last) = (0.0, None);
        for (index, point) in self.points.iter().enumerate() {
            let track_y_m = datum + point.y;
            let Some((rail_z, rail_curvature)) = rail.at(track_y_m) else {
                continue;
            };
            let interpenetration_m = point.z - rail_z;
            if let Some((before, cos)) = last {
                height += 0.5 * (point.cos + cos) * (interpenetration_m - before);
            }
            last = Some((interpenetration_m, point.cos));
            silhouette.push(SilhouettePoint {
                index,
                track_y_m,
                interpenetration_m,
                normal_height_m: height,
                slope: point.slope,
                curvature_per_m: rail_curvature - on_wheel[index].curvature_per_m,
            });
        }
    }
}

/// Interpolates a profile at mostly rising positions, without a search from the start.
struct Cursor<'a> {
    points: &'a [ProfilePoint],
    slopes: &'a [f64],
    i: usize,
}

impl Cursor<'_> {
    /// Depth (cubic Hermite interpolation) and curvature at `y`; `None` beyond the ends.
    fn at(&mut self, y: f64) -> Option<(f64, f64)> {
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
