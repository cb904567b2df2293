//! The contact ellipse in strips along the rolling direction, each in equal elements.

use std::f64::consts::{FRAC_1_PI, PI};

/// An element: a line across, at which its traction acts, and a point ahead of it, at which its slip is computed.
///
/// Line and point lie a quarter and three quarters of an element from its trailing edge: so placed, they give the
/// exact solution of plane strain, a traction that is zero at the leading edge (the vortex lattice of wing theory,
/// James 1972).
#[derive(Debug, Clone, Copy)]
pub(super) struct Element {
    /// Position of the line.
    pub(super) x: f64,
    /// Position of the strip's middle.
    pub(super) y: f64,
    /// Position of the point along.
    pub(super) slip_x: f64,
    /// Width of the strip, the line's length.
    pub(super) width: f64,
    /// Area of the element.
    pub(super) area: f64,
    /// Load on the rectangle of the element's size around the line, over its area.
    pub(super) pressure: f64,
}

/// Elements of an ellipse with `a b = 1`, strip by strip from the leading to the trailing edge; Hertz pressure of the
/// load 1. The strips are narrower towards the ends of the ellipse.
pub(super) fn elements(a_over_b: f64, along: usize, strips: usize) -> Vec<Element> {
    let (a, b) = (a_over_b.sqrt(), 1.0 / a_over_b.sqrt());
    let edge = |strip: usize| -b * (PI * strip as f64 / strips as f64).cos();
    let mut elements = Vec::with_capacity(along * strips);
    for strip in 0..strips {
        let (from, to) = (edge(strip), edge(strip + 1));
        let width = to - from;
        // Of the same area as the ellipse between the edges.
        let half = 0.5 * PI * (disc(to / b) - disc(from / b)) / width;
        let size = 2.0 * half / along as f64;
        let cubic = |y: f64| y - y.powi(3) / (3.0 * b * b);
        let load = 0.75 * a * (cubic(to) - cubic(from));
        // The quarter element before the first rectangle is left out.
        let carried = disc(1.0 - 0.25 * size / half) - disc(-1.0);
        for element in (0..along).rev() {
            let x = -half + (element as f64 + 0.25) * size;
            let part = disc((x + 0.5 * size) / half) - disc((x - 0.5 * size) / half);
            let area = size * width;
            elements.push(Element {
                x,
                y: 0.5 * (from + to),
                slip_x: x + 0.5 * size,
                width,
                area,
                pressure: load * part / (carried * area),
            });
        }
    }
    elements
}

/// Part of the unit disc's area below `x`, less one half.
fn disc(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    FRAC_1_PI * (x * (1.0 - x * x).sqrt() + x.asin())
}
