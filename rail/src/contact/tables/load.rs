//! The load of a wheel from its depth.

use super::{DEPTHS, LEVELS, ROOTS};
use crate::math::number::Number;

/// Added to the squared root, so that a wheel without load has no growth like 0/0.
const TINY: f64 = 1e-12;

/// Load of a wheel, and how its patches follow from the tables.
#[derive(Debug, Clone, Copy)]
pub(super) struct Load<T> {
    /// Cube root of the load, N^(1/3).
    pub root: T,
    /// Load, N.
    pub load: T,
    /// Derivative of the squared root with respect to the depth, divided by the squared root, 1/m.
    pub growth: T,
    /// Weight of the records at the greater one of the two loads that enclose the load.
    pub above: T,
}

/// Squared cube roots of no load and of each load, N^(2/3).
const SQUARES: [f64; DEPTHS] = {
    let mut squares = [0.0; DEPTHS];
    let mut k = 0;
    while k < LEVELS {
        squares[k + 1] = ROOTS[k] * ROOTS[k];
        k += 1;
    }
    squares
};

impl Load<f64> {
    pub const NONE: Self = Self {
        root: 0.0,
        load: 0.0,
        growth: 0.0,
        above: 0.0,
    };
}

impl<T: Number> Load<T> {
    /// The load of a wheel at `depth` between the depths `[low, high]` of the load with number `passed - 1` (or of no
    /// load) and the next one.
    ///
    /// Below the lowest load, the patches are those at the lowest load; above the highest, those at the highest.
    #[inline(always)]
    pub fn new(passed: usize, depth: T, [low, high]: [T; 2]) -> Self {
        let per_depth = (high - low).reciprocal();
        let part = (depth - low) * per_depth;
        let (from, to) = (SQUARES[passed - 1], SQUARES[passed]);
        let square = (part * (to - from) + from).not_negative();
        let root = square.sqrt();
        let above = if passed == 1 { part * 0.0 } else { part };
        Self {
            root,
            load: square * root,
            growth: per_depth * (to - from) / (square + TINY),
            above: -((-above + 1.0).not_negative()) + 1.0,
        }
    }
}
