//! Forces in full sliding, by direct quadrature.

use std::f64::consts::{PI, TAU};

use super::{ScaledCreepage, ScaledForces};

/// Forces of sliding rigid bodies: friction under Hertz pressure opposes the rigid slip everywhere. Rolling contact
/// approaches these forces as the creepage grows. The forces are zero without creepage.
///
/// ```
/// use dashpot_reference::rolling_contact::full_sliding;
/// // A circular contact in pure spin has no force and the moment 3 pi / 16.
/// let [x, y, moment] = full_sliding(1.0, [0.0, 0.0, 1.0]);
/// assert!(x.hypot(y) < 1e-12 && (moment + 3.0 * std::f64::consts::PI / 16.0).abs() < 1e-4);
/// ```
pub fn full_sliding(a_over_b: f64, [xi, eta, phi]: ScaledCreepage) -> ScaledForces {
    const RADII: u32 = 160;
    const ANGLES: u32 = 320;
    let (a, b) = (a_over_b.sqrt(), 1.0 / a_over_b.sqrt());
    let mut sum = [0.0; 3];
    for ring in 0..RADII {
        // With r = sin(q), the pressure cos(q) is smooth up to the edge.
        let width = 0.5 * PI / f64::from(RADII);
        let (radius, pressure) = ((f64::from(ring) + 0.5) * width).sin_cos();
        let load = 1.5 * pressure * pressure * radius * width / f64::from(ANGLES);
        for turn in 0..ANGLES {
            let (sin, cos) = ((f64::from(turn) + 0.5) * TAU / f64::from(ANGLES)).sin_cos();
            let (x, y) = (a * radius * cos, b * radius * sin);
            let slip = [xi - phi * y, eta + phi * x];
            let magnitude = slip[0].hypot(slip[1]);
            if magnitude > 0.0 {
                let p = slip.map(|slip| -load * slip / magnitude);
                sum[0] += p[0];
                sum[1] += p[1];
                sum[2] += x * p[1] - y * p[0];
            }
        }
    }
    // The load of all rings is 1 up to the error of the quadrature.
    sum.map(|sum| 2.0 * sum)
}
