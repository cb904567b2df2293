//! Slip of two equal elastic half-spaces under uniform tractions on the rectangles of a strip along the rolling
//! direction.

use std::f64::consts::PI;

use super::mesh::Element;

/// Slips per unit traction: `-du_x/dx` due to `px`, `-du_y/dx` due to `py`, and `-du_x/dx` due to `py`, which equals
/// `-du_y/dx` due to `px`. The shear modulus is 1.
pub(super) type Slip = [f64; 3];

/// Slip at each element of the strip `to` that a unit traction on each element of the strip `from` causes, ordered by
/// elements of `to`, then of `from`. The slip is the mean from an element's middle to the middle of the next element
/// ahead.
///
/// Tractions on the wheel and their opposites on the rail displace the two surfaces relative to each other by
/// (Cerruti; Johnson 1985, 3.75)
/// `u_x = 1/(pi G) ∫∫ ((1 - nu)/R + nu X^2/R^3) px + nu X Y/R^3 py dx dy`, and the same for `u_y` with `Y^2`,
/// where the vector `(X, Y)` of length `R` leads from the load to the point.
pub(super) fn slip_by_strip(to: &[Element], from: &[Element], poisson_ratio: f64) -> Vec<Slip> {
    let (size, from_size) = (to[0].length(), from[0].length());
    let distance = to[0].y - from[0].y;
    let sides = [
        distance + 0.5 * from[0].width,
        distance - 0.5 * from[0].width,
    ];
    // Integrals up to the edges of all rectangles of `from`; their differences are displacements.
    let displacements = |x: f64| -> Vec<[f64; 3]> {
        let up_to = |edge: f64| {
            let [one, other] = sides.map(|side| integrals([x - edge, side]));
            [0, 1, 2].map(|k| one[k] - other[k])
        };
        let leading = from[0].x + 0.5 * from_size;
        let edges: Vec<[f64; 3]> = std::iter::once(leading)
            .chain(from.iter().map(|element| element.x - 0.5 * from_size))
            .map(up_to)
            .collect();
        edges
            .windows(2)
            .map(|two| {
                let [xx, yy, xy] = [0, 1, 2].map(|k| (two[1][k] - two[0][k]) / PI);
                let direct = (1.0 - poisson_ratio) * (xx + yy);
                [
                    direct + poisson_ratio * xx,
                    direct + poisson_ratio * yy,
                    poisson_ratio * xy,
                ]
            })
            .collect()
    };
    let mut ahead = displacements(to[0].x + size);
    let mut slip = Vec::with_capacity(to.len() * from.len());
    for element in to {
        let here = displacements(element.x);
        let both = here.iter().zip(&ahead);
        slip.extend(both.map(|(here, ahead)| [0, 1, 2].map(|k| (here[k] - ahead[k]) / size)));
        ahead = here;
    }
    slip
}

/// Integrals over both coordinates of `X^2/R^3`, `Y^2/R^3` and `X Y/R^3`.
fn integrals([x, y]: [f64; 2]) -> [f64; 3] {
    // y asinh(x/|y|) is zero at y = 0.
    let product = |x: f64, y: f64| {
        if y == 0.0 {
            0.0
        } else {
            y * (x / y.abs()).asinh()
        }
    };
    [product(x, y), product(y, x), -x.hypot(y)]
}
