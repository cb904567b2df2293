//! A profile as samples of a spline, evenly spaced along the arc length.

use crate::math::spline::Spline;

/// Spacing of the samples along the arc length, m. The shortest relevant wave of a tread or rail is about 2 mm long; a
/// twentieth of that keeps positions within 0.1 um.
pub const SAMPLE_SPACING_M: f64 = 1e-4;
/// Minimum number of points of [`Profile::through`]; a cubic spline needs three knots.
pub const MIN_POINTS: usize = 3;
/// Maximum chord length of [`Profile::through`], m. A longer curve is in millimetres by mistake.
pub const MAX_LENGTH_M: f64 = 10.0;

/// Errors in the points of a profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// There are fewer than [`MIN_POINTS`] points.
    #[error("points: {found}, allowed: {MIN_POINTS} or more")]
    TooFewPoints {
        /// Number of points.
        found: usize,
    },
    /// A coordinate of a point is NaN or infinite, or its `y` does not exceed that of the previous point.
    #[error(
        "point {index}: ({y_m}, {z_m}) m, allowed: finite numbers with y rising from point to point"
    )]
    Point {
        /// Index of the point, from 0.
        index: usize,
        /// Its lateral coordinate, m.
        y_m: f64,
        /// Its depth, m.
        z_m: f64,
    },
    /// The curve is longer than [`MAX_LENGTH_M`].
    #[error("length of the profile: {length_m} m, allowed: {MAX_LENGTH_M} m or less")]
    TooLong {
        /// Chord length of the points, m.
        length_m: f64,
    },
    /// The smoothing length is negative, NaN or infinite.
    #[error("smoothing length: {smoothing_m} m, allowed: 0 or a positive number")]
    Smoothing {
        /// The smoothing length, m.
        smoothing_m: f64,
    },
    /// The smoothed curve folds back.
    #[error("the smoothed profile folds back near y_mm {y_mm:.2}: use a shorter smoothing length")]
    FoldedBySmoothing {
        /// Lateral position of the fold, mm.
        y_mm: f64,
    },
}

/// One sample of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ProfilePoint {
    /// Lateral position, positive to the field side, m.
    pub y_m: f64,
    /// Depth, positive down (away from the axle, into the rail), m.
    pub z_m: f64,
    /// Angle of the tangent, `atan(dz/dy)`, rad.
    pub angle_rad: f64,
    /// Curvature `d(angle)/d(arc)`, positive where a rail head is convex, 1/m.
    pub curvature_per_m: f64,
}

/// A named profile: samples [`SAMPLE_SPACING_M`] apart along the arc length, with rising `y`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Profile {
    name: String,
    points: Vec<ProfilePoint>,
}

impl Profile {
    /// Fits a cubic spline over the chord length to `points_m` (`[y, z]` in m, `y` rising), and resamples it.
    ///
    /// The amplitude of waves of length `smoothing_m`, m, is halved; at 0 the spline passes through every point.
    ///
    /// # Errors
    /// There are too few points; a coordinate is not finite or does not rise; the curve is longer than
    /// [`MAX_LENGTH_M`]; the smoothing length is negative; or the smoothed curve folds back.
    ///
    /// ```
    /// use dashpot_rail::profile::Profile;
    /// // A cylinder of 0.3 m radius, like the top of a rail head.
    /// let points: Vec<[f64; 2]> = (-20..=20)
    ///     .map(|i| f64::from(i) * 1e-3)
    ///     .map(|y| [y, 0.3 - (0.09 - y * y).sqrt()])
    ///     .collect();
    /// let head = Profile::through("head", &points, 0.0)?;
    /// assert!((head.at(5e-3).curvature_per_m - 1.0 / 0.3).abs() < 1e-3);
    /// # Ok::<(), dashpot_rail::profile::CurveError>(())
    /// ```
    pub fn through(
        name: impl Into<String>,
        points_m: &[[f64; 2]],
        smoothing_m: f64,
    ) -> Result<Self, CurveError> {
        Self::between_vertical_ends(name, points_m, smoothing_m, 0.0)
    }

    /// Builds a profile like [`Profile::through`], but cuts off an end beyond a vertical tangent if it is at most
    /// `width_m` wide.
    pub(super) fn between_vertical_ends(
        name: impl Into<String>,
        points_m: &[[f64; 2]],
        smoothing_m: f64,
        width_m: f64,
    ) -> Result<Self, CurveError> {
        check(points_m, smoothing_m)?;
        let mut profile = Self::resampled(name, points_m, smoothing_m);
        let ends = [points_m[0][0], points_m[points_m.len() - 1][0]];
        let vertical = |point: &ProfilePoint| libm::cos(point.angle_rad) <= 0.0;
        let at_end = |point: &ProfilePoint, end: usize| (point.y_m - ends[end]).abs() <= width_m;
        let points = &profile.points;
        let start = points
            .iter()
            .rposition(|point| vertical(point) && at_end(point, 0))
            .map_or(0, |last| last + 1);
        let end = points[start..]
            .iter()
            .position(|point| vertical(point) && at_end(point, 1))
            .map_or(points.len(), |first| start + first);
        let fold = points[start..end].iter().find(|point| vertical(point));
        if let Some(fold) = fold.or((end - start < MIN_POINTS).then_some(&points[0])) {
            return Err(CurveError::FoldedBySmoothing {
                y_mm: fold.y_m * 1e3,
            });
        }
        profile.points.truncate(end);
        profile.points.drain(..start);
        Ok(profile)
    }

    /// Builds a profile like [`Profile::through`], without checks, for three or more distinct successive points.
    pub(super) fn resampled(
        name: impl Into<String>,
        points_m: &[[f64; 2]],
        smoothing_m: f64,
    ) -> Self {
        let chord = chord_lengths(points_m);
        let length = chord[points_m.len() - 1];
        let lambda = (smoothing_m / std::f64::consts::TAU).powi(4);
        let axis = |k: usize| {
            let values: Vec<f64> = points_m.iter().map(|point| point[k]).collect();
            Spline::fit(&chord, &values, lambda)
        };
        let (y, z) = (axis(0), axis(1));
        let count = (length / SAMPLE_SPACING_M).ceil().max(2.0);
        let points = (0..=count as usize)
            .map(|i| {
                let t = length * i as f64 / count;
                let ([y, dy, ddy], [z, dz, ddz]) = (y.at(t), z.at(t));
                ProfilePoint {
                    y_m: y,
                    z_m: z,
                    angle_rad: libm::atan2(dz, dy),
                    curvature_per_m: (dy * ddz - dz * ddy) / libm::hypot(dy, dz).powi(3),
                }
            })
            .collect();
        Self {
            name: name.into(),
            points,
        }
    }

    /// Builds a profile from two or more samples with rising `y`.
    pub(crate) fn from_samples(name: String, points: Vec<ProfilePoint>) -> Self {
        Self { name, points }
    }

    /// The name of the profile.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The samples, with rising `y`.
    pub fn points(&self) -> &[ProfilePoint] {
        &self.points
    }

    /// Interpolates linearly between the samples at `y_m`; outside, returns the nearest end.
    pub fn at(&self, y_m: f64) -> ProfilePoint {
        let points = &self.points;
        let i = points
            .partition_point(|point| point.y_m <= y_m)
            .clamp(1, points.len() - 1);
        let (p, q) = (points[i - 1], points[i]);
        let t = ((y_m - p.y_m) / (q.y_m - p.y_m)).clamp(0.0, 1.0);
        let interpolate = |a: f64, b: f64| a + t * (b - a);
        ProfilePoint {
            y_m: interpolate(p.y_m, q.y_m),
            z_m: interpolate(p.z_m, q.z_m),
            angle_rad: interpolate(p.angle_rad, q.angle_rad),
            curvature_per_m: interpolate(p.curvature_per_m, q.curvature_per_m),
        }
    }
}

/// Checks the arguments of [`Profile::through`].
fn check(points_m: &[[f64; 2]], smoothing_m: f64) -> Result<(), CurveError> {
    if points_m.len() < MIN_POINTS {
        return Err(CurveError::TooFewPoints {
            found: points_m.len(),
        });
    }
    for (index, &[y_m, z_m]) in points_m.iter().enumerate() {
        let rises = index == 0 || y_m > points_m[index - 1][0];
        if !(y_m.is_finite() && z_m.is_finite() && rises) {
            return Err(CurveError::Point { index, y_m, z_m });
        }
    }
    let length_m = chord_lengths(points_m)[points_m.len() - 1];
    if length_m > MAX_LENGTH_M {
        return Err(CurveError::TooLong { length_m });
    }
    if !(smoothing_m >= 0.0 && smoothing_m.is_finite()) {
        return Err(CurveError::Smoothing { smoothing_m });
    }
    Ok(())
}

/// Cumulative chord length at each point.
fn chord_lengths(points: &[[f64; 2]]) -> Vec<f64> {
    let mut length = 0.0;
    let mut lengths = Vec::with_capacity(points.len());
    for (i, point) in points.iter().enumerate() {
        if i > 0 {
            length += libm::hypot(point[0] - points[i - 1][0], point[1] - points[i - 1][1]);
        }
        lengths.push(length);
    }
    lengths
}
