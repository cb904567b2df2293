//! One cell of the tables: interpolation between its eight nodes and the two loads that enclose the load.

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
use crate::math::number::{Number, transposed};

/// A wheel in a cell of the tables.
pub struct Cell<'a> {
    tables: &'a Tables,
    nodes: [&'a Node; 8],
    /// Weights of the eight nodes.
    weights: [f32; 8],
    /// Shift, roll and squared yaw.
    at: [Located; 3],
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

/// Weights of both ends of each axis at a position.
#[inline(always)]
fn ends(at: &[Located; 3]) -> [[f64; 2]; 3] {
    at.each(|at| [1.0 - at.position, at.position])
}

/// Weights of the eight nodes: products of the weights along each axis.
#[inline(always)]
fn products([shift, roll, yaw]: [[f64; 2]; 3]) -> [f32; 8] {
    let row = |roll: f64, yaw: f64| {
        let weight = roll * yaw;
        [(shift[0] * weight) as f32, (shift[1] * weight) as f32]
    };
    let ([a, b], [c, d]) = (row(roll[0], yaw[0]), row(roll[1], yaw[0]));
    let ([e, f], [g, h]) = (row(roll[0], yaw[1]), row(roll[1], yaw[1]));
    [a, b, c, d, e, f, g, h]
}

impl Load<f64> {
    const NONE: Self = Self {
        root: 0.0,
        load: 0.0,
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
        let part = (depth - low) / (high - low);
        let (from, to) = (SQUARES[passed - 1], SQUARES[passed]);
        let square = part * (to - from) + from;
        let root = square.sqrt();
        let above = if passed == 1 { part * 0.0 } else { part };
        Self {
            root,
            load: square * root,
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
        let [shifts, rolls, yaws] = &tables.axes;
        let [per_roll, per_squared_yaw] = tables.movements;
        let at = [
            shifts.locate(pose.lateral_m - per_roll * roll - per_squared_yaw * squared_yaw),
            rolls.locate(roll),
            yaws.locate(squared_yaw),
        ];
        let [roll_stride, yaw_stride] = tables.strides();
        let start = at[0].cell + at[1].cell * roll_stride + at[2].cell * yaw_stride;
        let pair = |offset: usize| {
            let (pairs, _) = tables.nodes[start + offset..].as_chunks::<2>();
            &pairs[0]
        };
        let pairs = [
            pair(0),
            pair(roll_stride),
            pair(yaw_stride),
            pair(yaw_stride + roll_stride),
        ];
        let [[a, b], [c, d], [e, f], [g, h]] = pairs;
        let nodes = [a, b, c, d, e, f, g, h];
        let weights = products(ends(&at));
        let mut cell = Self {
            tables,
            nodes,
            weights,
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
        let first = f32x8::from_slice(simd, &self.nodes[0].depths_m);
        // Differences between nodes are small, so they keep the accuracy that single precision gives the depths.
        let differences = self.depths_by(simd, &self.weights);
        let (low, high) = simd.widen_f32x8(first);
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

    /// Sum over the nodes of weights times depths, less the depths of the first node times the sum of the weights.
    #[inline(always)]
    fn depths_by<S: Simd>(&self, simd: S, weights: &[f32; 8]) -> f32x8<S> {
        let depths = |node: &Node| f32x8::from_slice(simd, &node.depths_m);
        let first = depths(self.nodes[0]);
        let mut sum = simd.splat_f32x8(0.0);
        let mut k = 1;
        while k < 8 {
            let weight = simd.splat_f32x8(weights[k]);
            sum = simd.mul_add_f32x8(depths(self.nodes[k]) - first, weight, sum);
            k += 1;
        }
        sum
    }

    /// The lower one of the two loads whose records are read.
    #[inline(always)]
    fn lower_level(&self) -> usize {
        self.passed.saturating_sub(2)
    }

    /// Sums over the nodes of weights times the records of a zone, at the lower and at the upper load.
    #[inline(always)]
    fn records_by<S: Simd>(&self, simd: S, weights: &[f32; 8], zone: usize) -> [f32x8<S>; 2] {
        let level = self.lower_level();
        let mut sums = [simd.splat_f32x8(0.0); 2];
        for (node, weight) in self.nodes.iter().zip(weights) {
            let Some(record) = node.record(zone) else {
                continue;
            };
            let two: &[_; 2] = match self.tables.records[record][level..].first_chunk() {
                Some(two) => two,
                None => continue,
            };
            let both = i16x16::from_slice(simd, two.as_flattened());
            let (low, high) = simd.widen_i16x16(both);
            let weight = simd.splat_f32x8(*weight);
            sums[0] = simd.mul_add_f32x8(simd.cvt_f32_i32x8(low), weight, sums[0]);
            sums[1] = simd.mul_add_f32x8(simd.cvt_f32_i32x8(high), weight, sums[1]);
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
        let [low, high] = self.records_by(simd, &self.weights, zone);
        let above = simd.splat_f32x8(self.load.above as f32);
        simd.mul_add_f32x8(high - low, above, low)
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

impl PatchReader for Cell<'_> {
    #[inline(always)]
    fn is_inside(&self) -> bool {
        let [shift, roll, yaw] = &self.at;
        shift.is_inside & roll.is_inside & yaw.is_inside
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
        let lanes = [p, q, r, s].each(|record| simd.split_f32x8(record));
        let [k, l, m, n] = transposed(simd, lanes.each(|(four, _)| four));
        let [t, u, v, w] = transposed(simd, lanes.each(|(_, four)| four));
        let in_lanes =
            |left: f64, right: f64| crate::math::number::load(simd, &[left, right, left, right]);
        unpacked(
            [k, l, m, n, t, u, v, w],
            in_lanes(left.load.load, right.load.load),
            in_lanes(left.load.root, right.load.root),
        )
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
        let mut depth_slopes = [[0.0_f32; DEPTHS]; 3];
        let mut record_slopes = [[[0.0_f32; FIELDS]; 2]; 3];
        for axis in 0..3 {
            let per_unit = self.at[axis].per_unit;
            if per_unit == 0.0 {
                continue;
            }
            let mut ends = ends(&self.at);
            ends[axis] = [-per_unit, per_unit];
            let weights = products(ends);
            depth_slopes[axis] = self.depths_by(simd, &weights).to_array();
            record_slopes[axis] = self
                .records_by(simd, &weights, zone)
                .each(|record| record.to_array());
        }
        let function = |value: f64, slopes: [f32; 3]| {
            Tangent::function(
                value,
                [0, 1, 2].map(|axis| (f64::from(slopes[axis]), values[axis])),
            )
        };
        let depth_at = |k: usize| function(self.depths_m[k], depth_slopes.map(|slopes| slopes[k]));
        let passed = self.passed.max(1);
        let load = Load::new(passed, depth, [depth_at(passed - 1), depth_at(passed)]);
        let values_of = self
            .records_by(simd, &self.weights, zone)
            .each(|record| record.to_array());
        let field = |n: usize| {
            let [low, high] = [0, 1].map(|end| {
                function(
                    f64::from(values_of[end][n]),
                    record_slopes.map(|slopes| slopes[end][n]),
                )
            });
            low + (high - low) * load.above
        };
        let numbers = unpacked(from_fn(field), load.load, load.root);
        (depth - depth_at(0), numbers)
    }
}
