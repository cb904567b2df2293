//! Divides the contact ellipse into strips along the rolling direction, and each strip into equal elements.

use std::f64::consts::{FRAC_1_PI, PI};

/// An element: a rectangle with a uniform traction. Its slip is the mean over the path from its middle to the middle of
/// the next element ahead.
#[derive(Debug, Clone, Copy)]
pub(super) struct Element {
    /// Position of the middle in the rolling direction.
    pub(super) x: f64,
    /// Position of the middle in the lateral direction, equal to that of the strip.
    pub(super) y: f64,
    /// Position of the path's middle in the rolling direction: the leading edge of the rectangle.
    pub(super) slip_x: f64,
    /// Width of the strip and the rectangle.
    pub(super) width: f64,
    /// Area of the element.
    pub(super) area: f64,
    /// Load on the rectangle over its area.
    pub(super) pressure: f64,
}

impl Element {
    /// Length in the rolling direction.
    pub(super) fn length(&self) -> f64 {
        self.area / self.width
    }
}

/// Distance from the trailing edge of the contact to the middle of the last rectangle, in elements; at the leading
/// edge, the distance is half an element longer.
///
/// A quarter is exact for line loads and slip at points in plane strain (the vortex lattice of wing theory, James
/// 1972). Here loads and slip are spread over an element. This multiplies the equations' spectrum by
/// `A(t) = 4 sin^2(t/2) sum_n (-1)^n sgn(t + 2 pi n)/(t + 2 pi n)^2`, which moves either end of the solution by
/// `sum_(n > 0) n a_n = 0.0753` elements, where `a_n` are the Fourier coefficients of `ln A` (Wiener and Hopf).
const END: f64 = 0.25 + 0.0753;

/// Elements of an ellipse with `a b = 1`, strip by strip from the leading to the trailing edge; Hertz pressure for a
/// load of 1. The strips become narrower towards the ends of the ellipse.
pub(super) fn elements(a_over_b: f64, along: usize, strips: usize) -> Vec<Element> {
    let (a, b) = (a_over_b.sqrt(), 1.0 / a_over_b.sqrt());
    let edge = |strip: usize| -b * (PI * strip as f64 / strips as f64).cos();
    let mut elements = Vec::with_capacity(along * strips);
    for strip in 0..strips {
        let (from, to) = (edge(strip), edge(strip + 1));
        let width = to - from;
        // The strip has the same area as the part of the ellipse between its edges.
        let half = 0.5 * PI * (disc(to / b) - disc(from / b)) / width;
        let size = 2.0 * half / (along as f64 - 0.5 + 2.0 * END);
        let cubic = |y: f64| y - y.powi(3) / (3.0 * b * b);
        let load = 0.75 * a * (cubic(to) - cubic(from));
        let middle = |element: usize| -half + (element as f64 + END) * size;
        let below = |x: f64| disc(x / half);
        // The parts of the ellipse beyond the rectangles at the ends are omitted.
        let carried = below(middle(along - 1) + 0.5 * size) - below(middle(0) - 0.5 * size);
        for x in (0..along).rev().map(middle) {
            let slip_x = x + 0.5 * size;
            let part = below(slip_x) - below(x - 0.5 * size);
            let area = size * width;
            elements.push(Element {
                x,
                y: 0.5 * (from + to),
                slip_x,
                width,
                area,
                pressure: load * part / (carried * area),
            });
        }
    }
    elements
}

/// Fraction of the unit disc's area below `x`, minus one half.
fn disc(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    FRAC_1_PI * (x * (1.0 - x * x).sqrt() + x.asin())
}
