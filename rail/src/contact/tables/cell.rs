//! One cell of the tables: what is read at a pose between its eight nodes.

use wide::{f32x4, f64x2};

use super::node::{Node, QUADS};
use super::patch::NUMBERS;
use crate::contact::source::{PatchReader, Slopes, with_interpenetration};
use crate::contact::zones::ZONES;

/// A cell of the tables and a place in it.
pub struct Cell<'a> {
    /// The two nodes along the shift, for both rolls at the first yaw, then at the second.
    pub(super) rows: [&'a [Node; 2]; 4],
    /// Place within the cell along shift, roll and squared yaw, from 0 to 1.
    pub(super) place: [f64; 3],
    /// Derivatives of the place by the value on each axis.
    pub(super) cells_per_unit: [f64; 3],
    /// Derivatives of the first and the last value by the yaw.
    pub(super) yaw_slopes: [f64; 2],
    pub(super) is_inside: bool,
    pub(super) weights: Weights,
}

/// Weights of the eight nodes of a cell: of both ends along the shift, for each row.
pub(super) struct Weights([[f64; 2]; 4]);

impl Weights {
    /// Products of the weights of both ends along each axis.
    #[inline(always)]
    pub fn new([shift, roll, yaw]: [[f64; 2]; 3]) -> Self {
        let shift = f64x2::from(shift);
        let row = |roll: f64, yaw: f64| (shift * f64x2::splat(roll * yaw)).to_array();
        Self([
            row(roll[0], yaw[0]),
            row(roll[1], yaw[0]),
            row(roll[0], yaw[1]),
            row(roll[1], yaw[1]),
        ])
    }

    /// The weights at `place`.
    #[inline(always)]
    pub fn at(place: [f64; 3]) -> Self {
        Self::new(ends(place))
    }
}

/// Weights of both ends of each axis at `place`.
#[inline(always)]
fn ends([shift, roll, yaw]: [f64; 3]) -> [[f64; 2]; 3] {
    [[1.0 - shift, shift], [1.0 - roll, roll], [1.0 - yaw, yaw]]
}

impl Cell<'_> {
    /// The weighted sums over the nodes of the vectors that `quads` takes from each.
    #[inline(always)]
    fn sums<const N: usize>(
        &self,
        weights: &Weights,
        quads: impl Fn(&Node) -> [f32x4; N],
    ) -> [[f32; 4]; N] {
        let mut sums = [f32x4::ZERO; N];
        for (row, weights) in self.rows.iter().zip(&weights.0) {
            for (node, weight) in row.iter().zip(weights) {
                let weight = f32x4::splat(*weight as f32);
                for (sum, quad) in sums.iter_mut().zip(quads(node)) {
                    *sum += quad * weight;
                }
            }
        }
        sums.map(|sum| sum.to_array())
    }

    #[inline(always)]
    fn interpenetrations(&self, weights: &Weights) -> [f64; ZONES] {
        let (mut first, mut last) = (f64x2::ZERO, f64x2::ZERO);
        for (row, weights) in self.rows.iter().zip(&weights.0) {
            for (node, weight) in row.iter().zip(weights) {
                let ([a, b, c, d], weight) = (node.interpenetrations, f64x2::splat(*weight));
                first += f64x2::from([a, b]) * weight;
                last += f64x2::from([c, d]) * weight;
            }
        }
        let ([a, b], [c, d]) = (first.to_array(), last.to_array());
        [a, b, c, d]
    }

    #[inline(always)]
    fn numbers_by(&self, weights: &Weights, zone: usize) -> [f64; NUMBERS] {
        let sums: [_; QUADS] = self.sums(weights, |node| node.numbers[zone]);
        let [[a, b, c, d], [e, f, g, h], [i, j, k, l]] = sums;
        [a, b, c, d, e, f, g, h, i, j, k, l].map(f64::from)
    }
}

impl PatchReader for Cell<'_> {
    #[inline(always)]
    fn is_inside(&self) -> bool {
        self.is_inside
    }

    #[inline(always)]
    fn interpenetrations_m(&self) -> [f64; ZONES] {
        self.interpenetrations(&self.weights)
    }

    #[inline(always)]
    fn numbers(&self, zone: usize) -> [f64; NUMBERS] {
        self.numbers_by(&self.weights, zone)
    }

    #[inline(always)]
    fn slopes(&self, zone: usize) -> [Slopes; 3] {
        let by_axis = |axis: usize| {
            let mut ends = ends(self.place);
            ends[axis] = [-1.0, 1.0];
            let weights = Weights::new(ends);
            let interpenetration = self.interpenetrations(&weights)[zone];
            with_interpenetration(interpenetration, self.numbers_by(&weights, zone))
                .map(|slope| slope * self.cells_per_unit[axis])
        };
        let [by_shift, by_roll, by_yaw_squared] = [by_axis(0), by_axis(1), by_axis(2)];
        let [shift, squared] = self.yaw_slopes;
        let by_yaw = std::array::from_fn(|n| shift * by_shift[n] + squared * by_yaw_squared[n]);
        [by_shift, by_roll, by_yaw]
    }
}
