//! The grid of a table: pieces equally spaced in the root `sqrt(scale u + shift) - sqrt(shift)`.
//!
//! With orifice flow a stage is `alpha s^2 + beta s = u` in the root s of the pressure; the shift
//! `scale beta^2/(4 alpha)` makes that root proportional to s, so flow and force are cubic in it.

use crate::math::elementary::sqrt;
use crate::table::PIECES;

/// Scale and shift of a grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// (1/m).
    pub(crate) scale: f64,
    /// (1).
    pub(crate) shift: f64,
}

impl Grid {
    /// A grid that holds stretches up to `reach` (m), with `knee = beta^2/(4 alpha)` (m), such that the
    /// corners (stretch (m), weight) lie as near as possible to borders of pieces (y half-integer).
    pub(crate) fn aligned(reach: f64, knee: f64, corners: &[(f64, f64)]) -> Self {
        let root = |stretch: f64| sqrt(stretch + knee) - sqrt(knee);
        let largest = (PIECES as f64 - 1.0) / root(reach);
        let smallest = 0.7 * largest;
        let misfit = |root_scale: f64| {
            corners
                .iter()
                .map(|&(stretch, weight)| {
                    let y = root_scale * root(stretch) - 0.5;
                    weight * (y - libm::round(y)).abs()
                })
                .fold(0.0, f64::max)
        };
        let mut best = (misfit(largest), largest);
        for root in corners.iter().map(|&(stretch, _)| root(stretch)) {
            let mut border = libm::ceil(smallest * root - 0.5) + 0.5;
            while border <= largest * root {
                let candidate = border / root;
                let found = misfit(candidate);
                if found < best.0 {
                    best = (found, candidate);
                }
                border += 1.0;
            }
        }
        let scale = best.1 * best.1;
        Self {
            scale,
            shift: scale * knee,
        }
    }

    /// Stretch at `y` (m).
    pub(crate) fn stretch(&self, y: f64) -> f64 {
        y * (y + 2.0 * sqrt(self.shift)) / self.scale
    }
}
