//! One cell of the tables: interpolation between four of its nodes and the two loads that enclose the load.
//!
//! A cell is divided into six tetrahedra, each for one order of the positions along shift, roll and yaw. Its corners
//! are reached from the first node of the cell by steps along the axes, the axis of the greatest position first (Kuhn's
//! triangulation). Four nodes cost half as much as eight, and derivatives are differences of neighbours.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, dispatch, f32x8, f64x4, i16x16};

use super::axis::Located;
use super::record::{FIELDS, UNITS};
use super::{DEPTHS, LEVELS, Node, ROOTS, Tables};
use crate::contact::motion::Tangent;
use crate::contact::patch_numbers::PatchNumbers;
use crate::contact::silhouette::WheelPose;
use crate::contact::source::PatchReader;
use crate::contact::zones::ZONES;
use crate::math::each::Each;
use crate::math::number::{Number, load, transposed};

/// Corners of a tetrahedron.
const CORNERS: usize = 4;

/// A wheel in a cell of the tables.
pub struct Cell<'a> {
    tables: &'a Tables,
    /// The corners of the tetrahedron.
    nodes: [&'a Node; CORNERS],
    /// The axis along which each corner after the first is reached.
    order: [u8; 3],
    /// Positions along these axes.
    falling: [f64; 3],
    /// Shift, roll and squared yaw.
    at: Located,
    depth_m: f64,
    /// Depths of the cell at no load and at each load, m.
    depths_m: [f64; DEPTHS],
    /// Number of depths that the wheel has passed: 0 if it does not touch the rail.
    passed: usize,
    load: Load<f64>,
}

/// Load of a wheel, and how its patches follow from the tables.
#[derive(Debug, Clone, Copy)]
struct Load<T> {
    /// Cube root of the load, N^(1/3).
    root: T,
    /// Load, N.
    load: T,
    /// Derivative of the squared root with respect to the depth, divided by the squared root, 1/m.
    growth: T,
    /// Weight of the records at the greater one of the two loads that enclose the load.
    above: T,
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

/// The axes in falling order of their positions.
#[inline(always)]
fn falling_order([shift, roll, yaw]: [f64; 3]) -> [u8; 3] {
    /// For each outcome of the comparisons below; two of them contradict each other.
    const ORDERS: [[u8; 3]; 8] = [
        [2, 1, 0],
        [2, 0, 1],
        [1, 2, 0],
        [0, 1, 2],
        [2, 1, 0],
        [0, 2, 1],
        [1, 0, 2],
        [0, 1, 2],
    ];
    let shift_is_before = [shift >= roll, shift >= yaw].each(usize::from);
    let outcome = shift_is_before[0] | usize::from(roll >= yaw) << 1 | shift_is_before[1] << 2;
    ORDERS[outcome]
}

impl Load<f64> {
    const NONE: Self = Self {
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
    fn new(passed: usize, depth: T, [low, high]: [T; 2]) -> Self {
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
    fn depths_of_nodes<S: Simd>(&self, simd: S) -> [f32x8<S>; CORNERS] {
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
    fn records_at<S: Simd>(&self, simd: S, node: &Node, zone: usize) -> Option<[f32x8<S>; 2]> {
        let levels = self.tables.records.get(node.record(zone)?)?;
        let level = self.lower_level();
        let both = i16x16::from_slice(simd, levels[level..level + 2].as_flattened());
        let (low, high) = simd.widen_i16x16(both);
        Some([simd.cvt_f32_i32x8(low), simd.cvt_f32_i32x8(high)])
    }

    /// The records of a zone at the lower and at the upper load, between the nodes.
    #[inline(always)]
    fn records<S: Simd>(&self, simd: S, zone: usize) -> [f32x8<S>; 2] {
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

/// Added to the share of a patch, so that a patch without load has no numbers like 0/0. Its reciprocal squared is a
/// number of single precision, as derivatives are.
const TINY: f64 = 1e-12;
/// Added to semi-axes, so that a patch without load has a shape, m.
const TINY_SEMI_AXIS_M: f64 = 1e-8;

/// The numbers of a patch from its record.
#[inline(always)]
fn unpacked<T: Number>(record: [T; FIELDS], load: T, root: T) -> PatchNumbers<T> {
    let [share, sine, wheel_y, wheel_z, a, b, whole, pressure] = record;
    let per = (share + TINY).reciprocal();
    let [
        unit,
        sine_unit,
        y_unit,
        z_unit,
        a_unit,
        b_unit,
        whole_unit,
        pressure_unit,
    ] = UNITS;
    let per_root = per * root;
    PatchNumbers {
        load: share * unit * load,
        whole_load: whole * per * (whole_unit / unit) * load,
        sine: sine * per * (sine_unit / unit),
        wheel_y: wheel_y * per * (y_unit / unit),
        wheel_z: wheel_z * per * (z_unit / unit),
        semi_axes: [
            a * per_root * (a_unit / unit) + TINY_SEMI_AXIS_M,
            b * per_root * (b_unit / unit) + TINY_SEMI_AXIS_M,
        ],
        peak_pressure: pressure * per_root * (pressure_unit / unit),
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

impl Cell<'_> {
    #[inline(always)]
    fn differentiated_in<S: Simd>(
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
