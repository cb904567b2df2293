//! A profile: a plane curve with tangent and curvature, sampled along its arc.

pub mod measured;
pub mod s1002;
pub mod uic60;

use crate::math::spline::Spline;

/// Distance of the samples along the arc, m. The shortest wave of a tread or rail worth keeping is
/// near 2 mm; a twentieth of it keeps positions within 0.1 um.
pub const STEP: f64 = 1e-4;

/// One point of a profile, in the profile's own axes: `y` to the field side, `z` down, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// Lateral place, positive to the field side, m.
    pub y: f64,
    /// Depth, positive down (away from the axle, into the rail), m.
    pub z: f64,
    /// Angle of the tangent, `atan(dz/dy)`, rad.
    pub angle: f64,
    /// Curvature `d(angle)/d(arc)`, positive where a rail head is convex, 1/m.
    pub curvature: f64,
}

/// Which body a profile belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// A wheel: flange on the negative `y` side, pointing down.
    Wheel,
    /// A rail: head up, gauge face on the negative `y` side.
    Rail,
}

/// A profile as points [`STEP`] apart along its arc, `y` rising.
#[derive(Debug, Clone)]
pub struct Profile {
    /// Name for people.
    pub name: String,
    /// The samples, `y` rising.
    pub points: Vec<ProfilePoint>,
}

impl Profile {
    /// The spline over the chord length of `places` (`y`, `z` in m, `y` rising), resampled.
    ///
    /// `smoothing` is the wavelength that is halved, m; 0 goes through every point.
    pub fn through(name: impl Into<String>, places: &[[f64; 2]], smoothing: f64) -> Self {
        let mut arc = Vec::with_capacity(places.len());
        let mut length = 0.0;
        for (i, place) in places.iter().enumerate() {
            if i > 0 {
                length += (place[0] - places[i - 1][0]).hypot(place[1] - places[i - 1][1]);
            }
            arc.push(length);
        }
        let lambda = (smoothing / std::f64::consts::TAU).powi(4);
        let axis = |k: usize| {
            let values: Vec<f64> = places.iter().map(|place| place[k]).collect();
            Spline::fit(&arc, &values, lambda)
        };
        let (y, z) = (axis(0), axis(1));
        let count = (length / STEP).ceil().max(2.0);
        let points = (0..=count as usize)
            .map(|i| {
                let t = length * i as f64 / count;
                let ([y, dy, ddy], [z, dz, ddz]) = (y.at(t), z.at(t));
                ProfilePoint {
                    y,
                    z,
                    angle: dz.atan2(dy),
                    curvature: (dy * ddz - dz * ddy) / dy.hypot(dz).powi(3),
                }
            })
            .collect();
        Self {
            name: name.into(),
            points,
        }
    }

    /// The point at `y`, linear between samples; the nearest end outside.
    pub fn at(&self, y: f64) -> ProfilePoint {
        let points = &self.points;
        let i = points
            .partition_point(|point| point.y <= y)
            .clamp(1, points.len() - 1);
        let (p, q) = (points[i - 1], points[i]);
        let share = ((y - p.y) / (q.y - p.y)).clamp(0.0, 1.0);
        let mix = |a: f64, b: f64| a + share * (b - a);
        ProfilePoint {
            y: mix(p.y, q.y),
            z: mix(p.z, q.z),
            angle: mix(p.angle, q.angle),
            curvature: mix(p.curvature, q.curvature),
        }
    }
}
