//! Removes the worn depth from a profile.

use dashpot_rail::profile::{Body, CurveError, Profile};

use crate::estimate::WearEstimate;
use crate::grid::{CELL_M, WearGrid, arcs};

/// Default half-width of the window over which the depth is averaged before it is removed, m.
pub const DEFAULT_SMOOTHING_M: f64 = 2e-3;

/// Errors from removing wear.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RemovalError {
    /// The worn profile is no profile.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// The cells of the wear are not those of the profile.
    #[error("wear: {found} cells, allowed: the {expected} cells of profile {profile}")]
    OtherProfile {
        /// Name of the profile.
        profile: String,
        /// Number of cells of the wear.
        found: usize,
        /// Number of cells of the profile.
        expected: usize,
    },
    /// The smoothing length is negative, NaN or infinite.
    #[error("smoothing length: {smoothing_m} m, allowed: 0 or a positive number")]
    Smoothing {
        /// The smoothing length, m.
        smoothing_m: f64,
    },
    /// The wear is deeper than the radius of the surface allows.
    #[error(
        "wear at y_mm {y_mm:.2}: {depth_mm:.3} mm, allowed: at most 0.4 of the radius of the surface; remove it in \
         shorter distances"
    )]
    TooDeep {
        /// Lateral position, mm.
        y_mm: f64,
        /// Depth, mm.
        depth_mm: f64,
    },
}

/// Maximum depth of removed wear in radii of a convex surface.
const MAX_RADII: f64 = 0.4;

/// Removes the estimated wear from the profile of `body` that it was computed for, along the normal of the surface, and
/// returns the worn profile.
///
/// The depth is first averaged with the window `1 + cos(pi s / l)` over the distances `s` up to `l = smoothing_m` along
/// the surface; a length of 0 leaves it as it is. The average keeps the area. On a curved surface the depth `d` is
/// corrected so that the area between the old and the new profile is the area lost: `v = d - d^2 k / 2` per length of
/// the surface, with the curvature `k`, positive where the material is convex.
///
/// # Errors
/// The wear is of another profile, is too deep, or the worn profile folds back.
///
/// ```
/// use dashpot_rail::profile::{Body, s1002};
/// use dashpot_wear::{Wear, WearGrid, WearLaw, removed};
/// let profile = s1002::profile();
/// let wear = Wear::new(WearGrid::new(&profile), WearLaw::default());
/// let same = removed(&profile, Body::Wheel, &wear.of_wheel(0.46), 2e-3)?;
/// assert_eq!(same.points(), profile.points());
/// # Ok::<(), dashpot_wear::RemovalError>(())
/// ```
pub fn removed(
    profile: &Profile,
    body: Body,
    wear: &WearEstimate,
    smoothing_m: f64,
) -> Result<Profile, RemovalError> {
    if !(smoothing_m >= 0.0 && smoothing_m.is_finite()) {
        return Err(RemovalError::Smoothing { smoothing_m });
    }
    let expected = WearGrid::new(profile).cells();
    if wear.cells.len() != expected {
        return Err(RemovalError::OtherProfile {
            profile: profile.name().to_owned(),
            found: wear.cells.len(),
            expected,
        });
    }
    if wear.cells.iter().all(|cell| cell.depth_m == 0.0) {
        return Ok(profile.clone());
    }
    // The z axis points out of the wheel's material, and into the rail's.
    let into = match body {
        Body::Wheel => -1.0,
        Body::Rail => 1.0,
    };
    let depths = averaged(wear, smoothing_m);
    let mut points_m = Vec::with_capacity(profile.points().len());
    for (point, [_, arc_m]) in profile.points().iter().zip(arcs(profile)) {
        let loss_m = depth_at(&depths, arc_m);
        let radii = into * point.curvature_per_m * loss_m;
        if radii.is_nan() || radii > MAX_RADII {
            return Err(RemovalError::TooDeep {
                y_mm: 1e3 * point.y_m,
                depth_mm: 1e3 * loss_m,
            });
        }
        let depth_m = into * 2.0 * loss_m / (1.0 + (1.0 - 2.0 * radii).sqrt());
        let (sin, cos) = point.angle_rad.sin_cos();
        points_m.push([point.y_m - depth_m * sin, point.z_m + depth_m * cos]);
    }
    Ok(Profile::through(profile.name(), &points_m, 0.0)?)
}

/// The depth at each cell, averaged over its neighbours. Each cell spreads its depth over the cells in its window, so
/// the sum is kept at the ends of the profile too.
fn averaged(wear: &WearEstimate, smoothing_m: f64) -> Vec<f64> {
    let cells = &wear.cells;
    let reach = (smoothing_m / CELL_M).ceil() as usize;
    let weight = |distance: usize| {
        let part = distance as f64 * CELL_M / smoothing_m;
        if distance == 0 {
            2.0
        } else if part < 1.0 {
            1.0 + (std::f64::consts::PI * part).cos()
        } else {
            0.0
        }
    };
    let mut depths = vec![0.0; cells.len()];
    for (cell, wear) in cells.iter().enumerate() {
        if wear.depth_m == 0.0 {
            continue;
        }
        let window = cell.saturating_sub(reach)..(cell + reach + 1).min(cells.len());
        let total: f64 = window.clone().map(|other| weight(cell.abs_diff(other))).sum();
        for other in window {
            depths[other] += wear.depth_m * weight(cell.abs_diff(other)) / total;
        }
    }
    depths
}

/// The depth between the middles of cells, linear; at the ends, that of the end cell.
fn depth_at(depths: &[f64], arc_m: f64) -> f64 {
    let position = (arc_m / CELL_M - 0.5).clamp(0.0, (depths.len() - 1) as f64);
    let cell = (position as usize).min(depths.len().saturating_sub(2));
    let part = position - cell as f64;
    let next = depths.get(cell + 1).copied().unwrap_or(depths[cell]);
    depths[cell] + part * (next - depths[cell])
}
