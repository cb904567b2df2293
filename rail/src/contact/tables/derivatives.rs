//! The numbers of a patch with their derivatives.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase};

use super::cell::Cell;
use super::load::Load;
use super::unpacked::unpacked;
use crate::contact::motion::Tangent;
use crate::contact::patch_numbers::PatchNumbers;
use crate::math::each::Each;

impl Cell<'_> {
    #[inline(always)]
    pub(super) fn differentiated_in<S: Simd>(
        &self,
        simd: S,
        zone: usize,
        [shift, roll, yaw, depth]: [Tangent; 4],
    ) -> (Tangent, PatchNumbers<Tangent>) {
        // The position in the cell along each axis, as a function of the pose.
        let squared = yaw * yaw;
        let [per_roll, per_squared_yaw] = self.tables.movements;
        let shift = shift - roll * per_roll - squared * per_squared_yaw;
        let values = [shift, roll, squared];
        let located = values.map(|value| value.value());
        let per_unit = self.tables.axes.per_unit(located, &self.at);
        let axes = self.order.map(|axis| usize::from(axis) % 3);
        let steps = axes.map(|axis| (per_unit[axis], values[axis]));
        // Differences from each corner to the next, which are the slopes along the axes.
        let function = |value: f64, slopes: [f32; 3]| {
            let term = |k: usize| {
                let (per_unit, of) = steps[k];
                (f64::from(slopes[k]) * per_unit, of)
            };
            Tangent::function(value, [0, 1, 2].map(term))
        };
        let depths = self.depths_of_nodes(simd);
        let depth_slopes = [0, 1, 2].map(|k| (depths[k + 1] - depths[k]).to_array());
        let depth_at = |k: usize| function(self.depths_m[k], depth_slopes.map(|slopes| slopes[k]));
        let passed = self.passed.max(1);
        let load = Load::new(passed, depth, [depth_at(passed - 1), depth_at(passed)]);
        let values_of = self.records(simd, zone).each(|record| record.to_array());
        let none = [simd.splat_f32x8(0.0); 2];
        let at_nodes = self
            .nodes
            .map(|node| self.records_at(simd, node, zone).unwrap_or(none));
        let field = |n: usize| {
            let [low, high] = [0, 1].map(|end| {
                let slope = |k: usize| at_nodes[k + 1][end][n] - at_nodes[k][end][n];
                function(f64::from(values_of[end][n]), [0, 1, 2].map(slope))
            });
            low + (high - low) * load.above
        };
        let numbers = unpacked(from_fn(field), load.load, load.root);
        (depth - depth_at(0), numbers)
    }
}
