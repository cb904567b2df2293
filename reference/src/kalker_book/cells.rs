//! Coordinates of the cells of the book of tables, and their creepages.

use dashpot_rail::creep::KalkerCoefficients;
use dashpot_rail::creep::kalker_book::Layout;

use crate::rolling_contact::ScaledCreepage;

/// A direction of creepage: `(x, y, z)` of length 1 in the coordinates of the book.
pub(super) type Direction = [f64; 3];

/// Middle of cell `index` of `cells` between 0 and 1.
fn middle(index: usize, cells: usize) -> f64 {
    (index as f64 + 0.5) / cells as f64
}

/// Coordinate `direction` at the middle of a cell, from -1 to 1.
pub(super) fn direction_coordinate(cell: usize) -> f64 {
    2.0 * middle(cell, Layout::CELLS[2]) - 1.0
}

/// Magnitude of the book's creepages at the middle of a cell on the `size` axis.
pub(super) fn magnitude(cell: usize) -> f64 {
    let size = middle(cell, Layout::CELLS[0]);
    size / (1.0 - size)
}

/// Direction at the middle of a cell on the `spin` axis and a cell on the `direction` axis.
pub(super) fn direction(spin: usize, direction: usize) -> Direction {
    let coordinate = middle(spin, Layout::CELLS[1]);
    // Newton's method solves h (9 - h^2) / 8 = coordinate.
    let mut h = coordinate;
    for _ in 0..50 {
        h -= (h * (9.0 - h * h) / 8.0 - coordinate) / ((9.0 - 3.0 * h * h) / 8.0);
    }
    let (sin_spin, cos_spin) = (2.0 * h.atan()).sin_cos();
    let (sin, cos) = (2.0 * direction_coordinate(direction).atan()).sin_cos();
    [cos_spin * cos, cos_spin * sin, sin_spin]
}

/// `(a + b)/2` over `sqrt(a b)`, the lever arm of spin if spin is large.
pub(super) fn spin_arm(a_over_b: f64) -> f64 {
    0.5 * (a_over_b.sqrt() + 1.0 / a_over_b.sqrt())
}

/// `(a^2 + b^2)/2` over `a b`, by which the book divides the scaled moments.
pub(super) fn moment_arm(a_over_b: f64) -> f64 {
    0.5 * (a_over_b + 1.0 / a_over_b)
}

/// Scaled creepage from the book's creepages `[x, y, z]`.
pub(super) fn creepage(
    book: [f64; 3],
    a_over_b: f64,
    kalker: &KalkerCoefficients,
) -> ScaledCreepage {
    let [x, y, z] = book;
    let part = |c: f64, q: f64| (1.0 + q) / (c / kalker.c22 + q);
    let arm = spin_arm(a_over_b);
    let at = |q: f64| [x * part(kalker.c11, q), y, z * part(kalker.c23 / arm, q)];
    // q = X^2 + Y^2 + Z^2 by bisection.
    let square = |q: f64| at(q).iter().map(|x| x * x).sum::<f64>();
    let (mut low, mut high) = (0.0, 1.0);
    while square(high) > high {
        high *= 2.0;
    }
    for _ in 0..100 {
        let q = 0.5 * (low + high);
        if square(q) > q {
            low = q;
        } else {
            high = q;
        }
    }
    let [x, y, z] = at(high).map(|scaled| scaled / kalker.c22);
    [x, y, z / arm]
}
