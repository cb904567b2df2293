//! Removes the worn depth from a profile.

use dashpot_rail::profile::{Body, CurveError, Profile};

use crate::estimate::{CellWear, WearEstimate};
use crate::grid::{CELL_M, WearGrid, arcs};

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
/// On a curved surface the depth `d` is corrected so that the area between the old and the new profile is the area
/// lost: `v = d - d^2 k / 2` per length of the surface, with the curvature `k`, positive where the material is convex.
/// Noise of the depth over a few millimetres becomes noise of the curvature: average it first, see
/// [`WearEstimate::averaged`].
///
/// # Errors
/// The wear is of another profile, is too deep, or the worn profile folds back.
///
/// ```
/// use dashpot_rail::profile::{Body, s1002};
/// use dashpot_wear::{Wear, WearGrid, WearLaw, removed};
/// let profile = s1002::profile();
/// let wear = Wear::new(WearGrid::new(&profile), WearLaw::default());
/// let same = removed(&profile, Body::Wheel, &wear.of_wheel(0.46))?;
/// assert_eq!(same.points(), profile.points());
/// # Ok::<(), dashpot_wear::RemovalError>(())
/// ```
pub fn removed(
    profile: &Profile,
    body: Body,
    wear: &WearEstimate,
) -> Result<Profile, RemovalError> {
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
    let mut points_m = Vec::with_capacity(profile.points().len());
    for (point, [_, arc_m]) in profile.points().iter().zip(arcs(profile)) {
        let loss_m = depth_at(&wear.cells, arc_m);
        let radii = into * point.curvature_per_m * loss_m;
        if radii.is_nan() || radii > MAX_RADII {
            return Err(RemovalError::TooDeep {
                y_mm: 1e3 * point.y_m,
                depth_mm: 1e3 * loss_m,
            });
        }
        let depth_m = into * 2.0 * loss_m / (1.0 + (1.0 - 2.0 * radii).sqrt());
        let (sin, cos) = libm::sincos(point.angle_rad);
        points_m.push([point.y_m - depth_m * sin, point.z_m + depth_m * cos]);
    }
    Ok(Profile::through(profile.name(), &points_m, 0.0)?)
}

/// The depth between the middles of cells, linear; at the ends, that of the end cell.
fn depth_at(cells: &[CellWear], arc_m: f64) -> f64 {
    let position = (arc_m / CELL_M - 0.5).clamp(0.0, (cells.len() - 1) as f64);
    let cell = (position as usize).min(cells.len().saturating_sub(2));
    let part = position - cell as f64;
    let [depth, next] = [cell, (cell + 1).min(cells.len() - 1)].map(|cell| cells[cell].depth_m);
    depth + part * (next - depth)
}
