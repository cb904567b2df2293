//! A rail as laid in the track: inclined, with its top at depth zero and its gauge face at half the gauge.

use super::installation::Installation;
use crate::profile::{Profile, ProfilePoint};

/// Returns the part of `rail` that a wheel can touch, in track axes: `y` from the track centre, `z` below the rail's
/// top.
///
/// `None` if the gauge side ends above the depth at which the gauge is measured.
pub(super) fn lay(rail: &Profile, installation: &Installation) -> Option<Profile> {
    let turn = libm::atan(installation.inclination);
    let (sin, cos) = libm::sincos(turn);
    let mut points: Vec<ProfilePoint> = rail
        .points()
        .iter()
        .map(|p| ProfilePoint {
            y_m: p.y_m * cos + p.z_m * sin,
            z_m: p.z_m * cos - p.y_m * sin,
            angle_rad: p.angle_rad - turn,
            curvature_per_m: p.curvature_per_m,
        })
        .collect();
    let top = (0..points.len())
        .min_by(|&i, &j| points[i].z_m.total_cmp(&points[j].z_m))
        .unwrap_or(0);
    // Below its widest point, an inclined head curves back, and no wheel can touch it there.
    let touchable = |p: &ProfilePoint| libm::cos(p.angle_rad) > 0.01;
    let end = (top..points.len()).find(|&i| !touchable(&points[i]));
    points.truncate(end.unwrap_or(points.len()));
    let start = (0..top).rev().find(|&i| !touchable(&points[i]));
    points.drain(..start.map_or(0, |start| start + 1));
    let crown = points.iter().map(|p| p.z_m).fold(f64::INFINITY, f64::min);
    let depth = installation.gauge_depth_m;
    let gauge_face = points
        .windows(2)
        .find(|pair| pair[0].z_m - crown >= depth && pair[1].z_m - crown < depth)
        .map(|pair| {
            let t = (pair[0].z_m - crown - depth) / (pair[0].z_m - pair[1].z_m);
            pair[0].y_m + t * (pair[1].y_m - pair[0].y_m)
        })?;
    for point in &mut points {
        point.y_m += 0.5 * installation.gauge_m - gauge_face;
        point.z_m -= crown;
    }
    Some(Profile::from_samples(rail.name().to_owned(), points))
}
