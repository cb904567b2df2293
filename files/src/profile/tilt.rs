//! Tilt of a rail profile in its own axes: shows whether its file already contains the inclination of the track.
//!
//! A new head is symmetric: both of its sides lean outwards by the same angle, 1:20 on most European rails. In a rail
//! laid with an inclination, the field side leans outwards more and the gauge side less. Wear cuts the gauge side and
//! the top, and leaves the field side and often the lowest part of the gauge side, so the tilt is measured there and
//! not at the top.

use std::f64::consts::FRAC_PI_2;

use dashpot_rail::profile::{Profile, ProfilePoint};

/// Depth below the top of the head at which its sides may begin, m: below the corner R 13 of a worn head.
const SIDE_DEPTH_M: f64 = 0.008;
/// Largest angle between a side and the axis of the head, rad; the top and its corners are flatter.
const MAX_LEAN_RAD: f64 = 0.16;
/// Smallest height of a straight side that determines its direction, m.
const STRAIGHT_M: f64 = 2.5e-3;
/// Distance from a line within which the points of a straight side lie, m.
const STRAIGHT_WITHIN_M: f64 = 0.035e-3;
/// Error of a point of a measured side across it, after smoothing, m.
const POINT_ERROR_M: f64 = 0.04e-3;
/// Uncertainty of the direction of a side that ends at its beginning, rad.
const SHORT_SIDE_RAD: f64 = 0.02;
/// Lean of both sides of most rail heads: 1:20.
const USUAL_LEAN_RAD: f64 = 0.05;
/// Uncertainty of [`USUAL_LEAN_RAD`]: some heads have sides of 1:40 or upright ones.
const LEAN_ERROR_RAD: f64 = 0.01;
/// Plausible leans of a head whose sides are both unworn, rad.
const PLAUSIBLE_LEANS_RAD: [f64; 2] = [-0.01, 0.062];
/// Uncertainty of the slope at the middle of the top, which wear turns, rad.
const TOP_ERROR_RAD: f64 = 0.02;

/// Part of a rail head from which its tilt was measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum TiltBasis {
    /// Both sides: half of the difference between their directions, whatever the lean of the head's sides.
    BothSides,
    /// The field side, if its lean in the upright head is 1:20.
    FieldSide,
    /// The gauge side, if its lean in the upright head is 1:20.
    GaugeSide,
    /// The slope at the middle of the top.
    Top,
}

/// Tilt of a rail profile in the axes of its file.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RailTilt {
    /// Tilt towards the track centre, rad; about zero for an upright rail, 0.025 for one laid at 1:40.
    pub tilt_rad: f64,
    /// Standard uncertainty of the tilt, rad.
    pub uncertainty_rad: f64,
    /// Where the tilt was measured.
    pub basis: TiltBasis,
}

impl RailTilt {
    /// True if the profile is nearer to a rail laid with `inclination` (0.025 is 1:40) than to an upright one, so that
    /// laying it again would tilt it twice; false without inclination.
    ///
    /// ```
    /// # use dashpot_files::profile::rail_tilt;
    /// let upright = rail_tilt(&dashpot_rail::profile::uic60::profile());
    /// assert!(upright.is_some_and(|tilt| !tilt.contains(0.025) && tilt.tilt_rad.abs() < 1e-3));
    /// ```
    pub fn contains(&self, inclination: f64) -> bool {
        let laid_rad = libm::atan(inclination);
        laid_rad != 0.0 && self.tilt_rad / laid_rad > 0.5
    }
}

/// Direction of one side of a head.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// Angle by which the side leans outwards, away from the head's middle, rad.
    lean_rad: f64,
    uncertainty_rad: f64,
}

/// Measures the tilt of `rail`, whose gauge side is at negative `y`; `None` for a profile without a top between two
/// falling sides.
///
/// The sides are measured where they are unworn. Of heads UIC 60 at tilts of 0, 1:40 and 1:20, with up to 6 mm of side
/// wear, 5 mm of head wear that turns the top by up to 30 mrad, noise of 0.02 mm and sides down to 18 to 36 mm,
/// [`RailTilt::contains`] misjudges less than 1 % for 1:40, and less than 0.2 % if both sides are measured to 24 mm.
/// A head whose sides are not 1:20 is measured wrongly by the difference if only one side is left: worn, not measured,
/// or upright and therefore removed by the reader, as the gauge side of a head with sides of 1:40 that is laid at 1:40.
pub fn rail_tilt(rail: &Profile) -> Option<RailTilt> {
    let points = rail.points();
    let top = (0..points.len()).min_by(|&i, &j| points[i].z_m.total_cmp(&points[j].z_m))?;
    let below_top = |point: &&ProfilePoint| point.z_m - points[top].z_m > SIDE_DEPTH_M;
    let gauge: Vec<&ProfilePoint> = points[..top].iter().filter(below_top).collect();
    let field: Vec<&ProfilePoint> = points[top..].iter().rev().filter(below_top).collect();
    let (gauge, field) = (side(&gauge, -1.0), side(&field, 1.0));
    let both = gauge.zip(field).filter(|(gauge, field)| {
        let lean = 0.5 * (gauge.lean_rad + field.lean_rad);
        (PLAUSIBLE_LEANS_RAD[0]..=PLAUSIBLE_LEANS_RAD[1]).contains(&lean)
    });
    if let Some((gauge, field)) = both {
        return Some(RailTilt {
            tilt_rad: 0.5 * (field.lean_rad - gauge.lean_rad),
            uncertainty_rad: 0.5 * libm::hypot(field.uncertainty_rad, gauge.uncertainty_rad),
            basis: TiltBasis::BothSides,
        });
    }
    // A worn gauge side leans more than an unworn one, so the field side decides if there are two.
    if let Some(field) = field {
        return Some(RailTilt {
            tilt_rad: field.lean_rad - USUAL_LEAN_RAD,
            uncertainty_rad: libm::hypot(field.uncertainty_rad, LEAN_ERROR_RAD),
            basis: TiltBasis::FieldSide,
        });
    }
    if let Some(gauge) = gauge.filter(|gauge| gauge.lean_rad < PLAUSIBLE_LEANS_RAD[1]) {
        return Some(RailTilt {
            tilt_rad: USUAL_LEAN_RAD - gauge.lean_rad,
            uncertainty_rad: libm::hypot(gauge.uncertainty_rad, LEAN_ERROR_RAD),
            basis: TiltBasis::GaugeSide,
        });
    }
    top_tilt(points, top)
}

/// Measures a side from its lowest straight part; `points` begin at its lower end, `outwards` is the sign of its `y`.
fn side(points: &[&ProfilePoint], outwards: f64) -> Option<Side> {
    let first = points.first()?;
    let is_side = |side: &Side| side.lean_rad.abs() < MAX_LEAN_RAD;
    let height_m = |count: usize| first.z_m - points[count - 1].z_m;
    let straight = (2..=points.len())
        .rev()
        .take_while(|count| height_m(*count) >= STRAIGHT_M)
        .find_map(|count| line(&points[..count], outwards));
    // Without one, the tangent at the end of the profile, which an almost upright side leaves at its beginning.
    let side = straight.unwrap_or(Side {
        lean_rad: FRAC_PI_2 - outwards * first.angle_rad,
        uncertainty_rad: SHORT_SIDE_RAD,
    });
    Some(side).filter(is_side)
}

/// Fits a line to `points` by least squares of `y` over `z`; `None` if they are not straight.
fn line(points: &[&ProfilePoint], outwards: f64) -> Option<Side> {
    let count = points.len() as f64;
    let mean = |of: fn(&ProfilePoint) -> f64| points.iter().map(|p| of(p)).sum::<f64>() / count;
    let (y, z) = (mean(|p| p.y_m), mean(|p| p.z_m));
    let (mut square, mut product) = (0.0, 0.0);
    for point in points {
        square += (point.z_m - z).powi(2);
        product += (point.z_m - z) * (point.y_m - y);
    }
    let slope = product / square;
    let is_near = |p: &&ProfilePoint| (p.y_m - y - slope * (p.z_m - z)).abs() < STRAIGHT_WITHIN_M;
    points.iter().all(is_near).then(|| Side {
        lean_rad: libm::atan(outwards * slope),
        uncertainty_rad: POINT_ERROR_M / (points[0].z_m - points[points.len() - 1].z_m),
    })
}

/// Measures the tilt at the middle between the two corners of the top.
fn top_tilt(points: &[ProfilePoint], top: usize) -> Option<RailTilt> {
    const CORNER_RAD: f64 = 0.5;
    let gauge = points[..top]
        .iter()
        .rposition(|p| p.angle_rad < -CORNER_RAD)?;
    let field = top
        + points[top..]
            .iter()
            .position(|p| p.angle_rad > CORNER_RAD)?;
    let middle_m = 0.5 * (points[gauge].y_m + points[field].y_m);
    let middle = points.iter().find(|p| p.y_m >= middle_m)?;
    Some(RailTilt {
        tilt_rad: -middle.angle_rad,
        uncertainty_rad: TOP_ERROR_RAD,
        basis: TiltBasis::Top,
    })
}
