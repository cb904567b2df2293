//! One cell of the tables: interpolation between four of its nodes and the two loads that enclose the load.
//!
//! A cell is divided into six tetrahedra, each for one order of the positions along shift, roll and yaw. Its corners
//! are reached from the first node of the cell by steps along the axes, the axis of the greatest position first (Kuhn's
//! triangulation). Four nodes cost half as much as eight, and derivatives are differences of neighbours.

use fearless_simd::{Simd, SimdBase, f32x8, f64x4, i16x16};

use super::axis::{Located, falling_order};
use super::load::Load;
use super::unpacked::unpacked;
use super::{DEPTHS, LEVELS, Node, Tables};
use crate::contact::motion::Tangent;
use crate::contact::patch_numbers::PatchNumbers;
use crate::contact::silhouette::WheelPose;
use crate::contact::source::PatchReader;
use crate::contact::zones::ZONES;
use crate::math::dispatch::dispatch;
use crate::math::each::Each;
use crate::math::number::{load, transposed};

/// Corners of a tetrahedron.
const CORNERS: usize = 4;

/// A wheel in a cell of the tables.
pub struct Cell<'a> {
    pub(super) tables: &'a Tables,
    /// The corners of the tetrahedron.
    pub(super) nodes: [&'a Node; CORNERS],
    /// The axis along which each corner after the first is reached.
    pub(super) order: [u8; 3],
    /// Positions along these axes.
    pub(super) falling: [f64; 3],
    /// Shift, roll and squared yaw.
    pub(super) at: Located,
    pub(super) depth_m: f64,
    /// Depths of the cell at no load and at each load, m.
    pub(super) depths_m: [f64; DEPTHS],
    /// Number of depths that the wheel has passed: 0 if it does not touch the rail.
    pub(super) passed: usize,
    pub(super) load: Load<f64>,
}

impl<'a> Cell<'a> {
    #[inline(always)]
    pub(super) fn new<S: Simd>(
        simd: S,
        tables: &'a Tables,
        pose: &WheelPose,
        depth_m: f64,
    ) -> Self {
        let (roll, squared_yaw) = (pose.roll_rad, pose.yaw_rad * pose.yaw_rad);
        let [per_roll, per_squared_yaw] = tables.movements;
        let shift = pose.lateral_m - per_roll * roll - per_squared_yaw * squared_yaw;
        let at = tables.axes.locate(simd, [shift, roll, squared_yaw]);
        let order = falling_order(at.positions);
        let strides = tables.strides;
        let [first, second, third] = order.each(|axis| usize::from(axis) % 3);
        let start = at.cells[0] + at.cells[1] * strides[1] + at.cells[2] * strides[2];
        let after_first = start + strides[first];
        let after_second = after_first + strides[second];
        let node = |node: usize| match tables.nodes.get(node) {
            Some(node) => node,
            None => &tables.nodes[0],
        };
        let mut cell = Self {
            tables,
            nodes: [
                node(start),
                node(after_first),
                node(after_second),
                node(after_second + strides[third]),
            ],
            order,
            falling: [first, second, third].each(|axis| at.positions[axis]),
            at,
            depth_m,
            depths_m: [0.0; DEPTHS],
            passed: 0,
            load: Load::NONE,
        };
        cell.interpolate_depths(simd);
        cell
    }

    /// Sets the depths and the load.
    #[inline(always)]
    fn interpolate_depths<S: Simd>(&mut self, simd: S) {
        let [a, b, c, d] = self.depths_of_nodes(simd);
        let [first, second, third] = self.falling.each(|part| simd.splat_f32x8(part as f32));
        // Differences between nodes are small, so they keep the accuracy that single precision gives the depths.
        let differences = (b - a) * first;
        let differences = differences + (c - b) * second;
        let differences = differences + (d - c) * third;
        let (low, high) = simd.widen_f32x8(a);
        let (low_difference, high_difference) = simd.widen_f32x8(differences);
        let (low, high) = (low + low_difference, high + high_difference);
        let depth = simd.splat_f64x4(self.depth_m);
        let below = |depths: f64x4<S>| {
            simd.to_bitmask_mask64x4(simd.simd_gt_f64x4(depth, depths))
                .count_ones() as usize
        };
        // Beyond the highest load, its depth is extrapolated.
        self.passed = (below(low) + below(high)).min(LEVELS);
        low.store_slice(&mut self.depths_m[..4]);
        high.store_slice(&mut self.depths_m[4..]);
        let passed = self.passed;
        if passed > 0 {
            let ends = [self.depths_m[passed - 1], self.depths_m[passed]];
            self.load = Load::new(passed, self.depth_m, ends);
        }
    }

    #[inline(always)]
    pub(super) fn depths_of_nodes<S: Simd>(&self, simd: S) -> [f32x8<S>; CORNERS] {
        self.nodes
            .each(|node| f32x8::from_slice(simd, &node.depths_m))
    }

    /// The lower one of the two loads whose records are read.
    #[inline(always)]
    fn lower_level(&self) -> usize {
        self.passed.saturating_sub(2).min(LEVELS - 2)
    }

    /// The records of a zone at a node, at the lower and at the upper load; `None` if the node has no such patch.
    #[inline(always)]
    pub(super) fn records_at<S: Simd>(
        &self,
        simd: S,
        node: &Node,
        zone: usize,
    ) -> Option<[f32x8<S>; 2]> {
        let levels = self.tables.records.get(node.record(zone)?)?;
        let level = self.lower_level();
        let both = i16x16::from_slice(simd, levels[level..level + 2].as_flattened());
        let (low, high) = simd.widen_i16x16(both);
        Some([simd.cvt_f32_i32x8(low), simd.cvt_f32_i32x8(high)])
    }

    /// The records of a zone at the lower and at the upper load, between the nodes.
    #[inline(always)]
    pub(super) fn records<S: Simd>(&self, simd: S, zone: usize) -> [f32x8<S>; 2] {
        let [first, second, third] = self.falling;
        let weights = [1.0 - first, first - second, second - third, third];
        let mut sums = [simd.splat_f32x8(0.0); 2];
        for (node, weight) in self.nodes.iter().zip(weights) {
            let Some([low, high]) = self.records_at(simd, node, zone) else {
                continue;
            };
            let weight = simd.splat_f32x8(weight as f32);
            sums[0] += low * weight;
            sums[1] += high * weight;
        }
        sums
    }

    /// The records of two zones. Most wheels have one loaded patch, which is then listed twice.
    #[inline(always)]
    fn two<S: Simd>(&self, simd: S, zones: [usize; 2]) -> [f32x8<S>; 2] {
        let first = self.record(simd, zones[0]);
        if zones[0] == zones[1] {
            [first; 2]
        } else {
            [first, self.record(simd, zones[1])]
        }
    }

    /// The record of a zone at the load of the wheel.
    #[inline(always)]
    fn record<S: Simd>(&self, simd: S, zone: usize) -> f32x8<S> {
        let [low, high] = self.records(simd, zone);
        let above = simd.splat_f32x8(self.load.above as f32);
        low + (high - low) * above
    }
}

/// The numbers of the patches of four wheels from their records.
#[inline(always)]
fn unpacked_in_lanes<S: Simd>(
    simd: S,
    wheels: [&Cell<'_>; 4],
    records: [f32x8<S>; 4],
) -> PatchNumbers<f64x4<S>> {
    let lanes = records.each(|record| simd.split_f32x8(record));
    let [k, l, m, n] = transposed(simd, lanes.each(|(four, _)| four));
    let [t, u, v, w] = transposed(simd, lanes.each(|(_, four)| four));
    let loads = wheels.each(|wheel| wheel.load.load);
    let roots = wheels.each(|wheel| wheel.load.root);
    let fields = [k, l, m, n, t, u, v, w];
    unpacked(fields, load(simd, &loads), load(simd, &roots))
}

impl PatchReader for Cell<'_> {
    #[inline(always)]
    fn is_inside(&self) -> bool {
        self.at.is_inside
    }

    #[inline(always)]
    fn loaded_zones(&self) -> u32 {
        if self.passed == 0 {
            return 0;
        }
        let mut loaded = 0;
        for node in self.nodes {
            loaded |= node.loaded;
        }
        let of_low = loaded >> (self.lower_level() * ZONES);
        (of_low | of_low >> ZONES) & ((1 << ZONES) - 1)
    }

    #[inline(always)]
    fn approach_m(&self) -> f64 {
        self.depth_m - self.depths_m[0]
    }

    #[inline(always)]
    fn growth_per_m(&self) -> f64 {
        1.5 * self.load.growth
    }

    fn numbers(&self, zone: usize) -> PatchNumbers<f64> {
        let record: [f32; 8] =
            dispatch!(crate::math::level(), simd => self.record(simd, zone).to_array());
        unpacked(record.map(f64::from), self.load.load, self.load.root)
    }

    #[inline(always)]
    fn numbers_in_lanes<S: Simd>(
        simd: S,
        [left, right]: [&Self; 2],
        [a, b, c, d]: [usize; 4],
    ) -> PatchNumbers<f64x4<S>> {
        let ([p, r], [q, s]) = (left.two(simd, [a, c]), right.two(simd, [b, d]));
        unpacked_in_lanes(simd, [left, right, left, right], [p, q, r, s])
    }

    #[inline(always)]
    fn numbers_of_four<S: Simd>(
        simd: S,
        wheels: [&Self; 4],
        [a, b, c, d]: [usize; 4],
    ) -> PatchNumbers<f64x4<S>> {
        let [first, second, third, fourth] = wheels;
        let records = [
            first.record(simd, a),
            second.record(simd, b),
            third.record(simd, c),
            fourth.record(simd, d),
        ];
        unpacked_in_lanes(simd, wheels, records)
    }

    fn differentiated(
        &self,
        zone: usize,
        coordinates: [Tangent; 4],
    ) -> (Tangent, PatchNumbers<Tangent>) {
        dispatch!(crate::math::level(), simd => self.differentiated_in(simd, zone, coordinates))
    }
}
