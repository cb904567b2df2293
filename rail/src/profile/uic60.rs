//! The rail head UIC 60 (60E1, EN 13674-1) from its definition: tangent arcs on an upright axis.

use super::{Profile, STEP};

/// Radii of the head from the top to the side, mm.
pub const RADII_MM: [f64; 3] = [300.0, 80.0, 13.0];
/// Lateral places of the joints R300-R80 and R80-R13, mm.
pub const JOINTS_MM: [f64; 2] = [10.499_79, 25.988_03];
/// Slope of the side: 1 across on 20 down.
const SIDE: f64 = 1.0 / 20.0;
/// The side is kept down to this depth, mm: below it the head turns under.
const DEEPEST_MM: f64 = 36.0;

/// Place (lateral, depth), mm, at `arc` mm from the top along the field half.
pub fn place_mm(arc: f64) -> [f64; 2] {
    let [mut y, mut z, mut angle, mut left] = [0.0, 0.0, 0.0, arc];
    let upright = (1.0 / SIDE).atan();
    for (i, radius) in RADII_MM.into_iter().enumerate() {
        let centre_y = y - radius * f64::sin(angle);
        let end = match JOINTS_MM.get(i) {
            Some(joint) => ((joint - centre_y) / radius).asin(),
            None => upright,
        };
        let turn = (left / radius).min(end - angle);
        let next = angle + turn;
        y += radius * (next.sin() - angle.sin());
        z += radius * (angle.cos() - next.cos());
        left -= turn * radius;
        angle = next;
        if left <= 0.0 {
            return [y, z];
        }
    }
    [y + left * upright.cos(), z + left * upright.sin()]
}

/// The profile from one side of the head to the other, top at the origin.
pub fn profile() -> Profile {
    let step = 1e3 * STEP;
    let half: Vec<[f64; 2]> = (0..)
        .map(|i| place_mm(f64::from(i) * step))
        .take_while(|place| place[1] < DEEPEST_MM)
        .map(|[y, z]| [y * 1e-3, z * 1e-3])
        .collect();
    let places: Vec<[f64; 2]> = half[1..]
        .iter()
        .rev()
        .map(|[y, z]| [-y, *z])
        .chain(half.iter().copied())
        .collect();
    Profile::through("UIC 60", &places, 0.0)
}
