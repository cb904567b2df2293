//! The rail head UIC 60 (60E1, EN 13674-1) from its definition: tangent arcs about a vertical axis of symmetry.

use super::{Profile, SAMPLE_SPACING_M};

/// Radii of the head from the top to the side, mm.
pub const RADII_MM: [f64; 3] = [300.0, 80.0, 13.0];
/// Lateral positions of the joints from R 300 to R 80 and from R 80 to R 13, mm.
pub const JOINTS_MM: [f64; 2] = [10.499_79, 25.988_03];
/// Inclination of the side of the head: 1 across to 20 down.
const SIDE_INCLINATION: f64 = 1.0 / 20.0;
/// Depth at which the profile ends, mm. Below, the head curves back towards the web.
const MAX_DEPTH_MM: f64 = 36.0;

/// Lateral position and depth of the field half at the arc length `arc_mm` from the top, mm.
///
/// ```
/// // EN 13674-1: R 300 ends 10.5 mm from the middle, 0.18 mm down.
/// let [y_mm, z_mm] = dashpot_rail::profile::uic60::position_mm(10.502);
/// assert!((y_mm - 10.4998).abs() < 1e-3 && (z_mm - 0.1838).abs() < 1e-4);
/// ```
pub fn position_mm(arc_mm: f64) -> [f64; 2] {
    let [mut y, mut z, mut angle, mut remaining] = [0.0, 0.0, 0.0, arc_mm];
    let side_angle = libm::atan(1.0 / SIDE_INCLINATION);
    for (i, radius) in RADII_MM.into_iter().enumerate() {
        let centre_y = y - radius * libm::sin(angle);
        let end = match JOINTS_MM.get(i) {
            Some(joint) => libm::asin((joint - centre_y) / radius),
            None => side_angle,
        };
        let turn = (remaining / radius).min(end - angle);
        let next = angle + turn;
        y += radius * (libm::sin(next) - libm::sin(angle));
        z += radius * (libm::cos(angle) - libm::cos(next));
        remaining -= turn * radius;
        angle = next;
        if remaining <= 0.0 {
            return [y, z];
        }
    }
    [
        y + remaining * libm::cos(side_angle),
        z + remaining * libm::sin(side_angle),
    ]
}

/// The profile from one side of the head to the other, with its top at the origin.
pub fn profile() -> Profile {
    let step = 1e3 * SAMPLE_SPACING_M;
    let half: Vec<[f64; 2]> = (0..)
        .map(|i| position_mm(f64::from(i) * step))
        .take_while(|position| position[1] < MAX_DEPTH_MM)
        .map(|[y, z]| [y * 1e-3, z * 1e-3])
        .collect();
    let points: Vec<[f64; 2]> = half[1..]
        .iter()
        .rev()
        .map(|[y, z]| [-y, *z])
        .chain(half.iter().copied())
        .collect();
    Profile::resampled("UIC 60", &points, 0.0)
}
