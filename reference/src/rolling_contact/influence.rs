//! Slip of two equal elastic half-spaces by a traction along a line across the rolling direction.

use std::f64::consts::PI;

/// `[-du_x/dx by px, -du_y/dx by py, -du_x/dx by py]` at `point` by a unit line load from `-width/2` to `width/2`
/// across, at `x = 0`; shear modulus 1. The last one is also `-du_y/dx by px`.
///
/// Tractions on the wheel and their opposites on the rail displace the two surfaces against each other by
/// (Cerruti; Johnson 1985, 3.75)
/// `u_x = 1/(pi G) ∫ ((1 - nu)/R + nu X^2/R^3) px + nu X Y/R^3 py dy`, likewise `u_y` with `Y^2`, where
/// `(X, Y)` leads from the load to the point and `R` is its length.
pub(super) fn slip_by_line(point: [f64; 2], width: f64, poisson_ratio: f64) -> [f64; 3] {
    let [x, y] = point;
    let ends = [y - 0.5 * width, y + 0.5 * width];
    let difference = |f: &dyn Fn(f64, f64) -> f64| {
        let [from, to] = ends.map(|end| f(end, x.hypot(end)));
        to - from
    };
    // ∫ X/R^3 dY = Y/(X R), which is sign(Y) (1/X - X/(R (R + |Y|))): without a pole beside the line.
    let pole = if ends[0] < 0.0 && ends[1] > 0.0 {
        2.0 / x
    } else {
        0.0
    };
    let direct = pole - difference(&|y, r| y.signum() * x / (r * (r + y.abs())));
    let along = difference(&|y, r| x * y / r.powi(3));
    let cross = difference(&|y, r| y * y / r.powi(3));
    [
        (1.0 - poisson_ratio) * direct + poisson_ratio * along,
        (1.0 - poisson_ratio) * direct + poisson_ratio * (direct - along),
        poisson_ratio * cross,
    ]
    .map(|slip| slip / PI)
}
