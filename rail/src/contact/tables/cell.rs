//! One cell of the tables: interpolation between its eight nodes.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, dispatch, f32x4, f32x8, f64x4};

use super::axis::whole;
use super::node::Node;
use super::{Finder, Tables};
use crate::contact::source::{PatchReader, PatchSlopes};
use crate::contact::tabulated_patch::{NUMBERS, PatchNumbers};
use crate::contact::zones::ZONES;
use crate::math::each::Each;
use crate::math::number::{Number, load, transposed};

/// A cell of the tables, and a position in it.
pub struct Cell<'a> {
    tables: &'a Tables,
    /// Pairs of nodes along the shift: both rolls at the first yaw, then both rolls at the second yaw.
    rows: [&'a [Node; 2]; 4],
    /// Weights of the eight nodes.
    weights: [f32; 8],
    interpenetrations: [f64; ZONES],
    cells: [f64; 3],
    /// Position within the cell along shift, roll and squared yaw, 0 to 1.
    position: [f64; 3],
    yaw: f64,
    is_inside: bool,
}

/// Poses of one wheel or of two, located in the cells of their tables.
pub(super) struct LocatedPoses<S: Simd> {
    start: f64x4<S>,
    cells: [f64x4<S>; 3],
    position: [f64x4<S>; 3],
    weights: [f64x4<S>; 8],
    yaw: f64x4<S>,
    outside_squared: f64x4<S>,
}

impl<S: Simd> LocatedPoses<S> {
    #[inline(always)]
    pub fn new(finder: &Finder, [lateral, roll, yaw]: [f64x4<S>; 3]) -> Self {
        let (simd, yaw_squared) = (yaw.simd, yaw * yaw);
        let [shifts, rolls, yaws] = &finder.axes;
        let shift = shifts.locate(lateral + load(simd, &finder.yaw_shift) * yaw_squared);
        let (roll, yaw_squared) = (rolls.locate(roll), yaws.locate(yaw_squared));
        let [roll_stride, yaw_stride] = finder.strides.each(|stride| load(simd, &stride));
        let position = [shift.position, roll.position, yaw_squared.position];
        Self {
            start: yaw_squared.cell * yaw_stride + roll.cell * roll_stride + shift.cell,
            cells: [shift.cell, roll.cell, yaw_squared.cell],
            position,
            weights: products(ends(position)),
            yaw,
            outside_squared: shift.outside * shift.outside
                + roll.outside * roll.outside
                + yaw_squared.outside * yaw_squared.outside,
        }
    }

    /// The weights of the eight nodes in one lane, in single precision.
    #[inline(always)]
    fn single_weights(&self, lane: usize) -> [f32; 8] {
        let simd = self.yaw.simd;
        let [a, b, c, d, e, f, g, h] = self.weights;
        let pairs = [(a, b), (c, d), (e, f), (g, h)].each(|(a, b)| simd.narrow_f64x4(a, b));
        let [p, q, r, s] = pairs.each(|pair| (pair[lane], pair[lane + 4]));
        [p.0, p.1, q.0, q.1, r.0, r.1, s.0, s.1]
    }
}

/// Weights of both ends of each axis at `position`.
#[inline(always)]
fn ends<T: Number>(position: [T; 3]) -> [[T; 2]; 3] {
    position.each(|position| [-position + 1.0, position])
}

/// Weights of the eight nodes: products of the weights along each axis.
#[inline(always)]
fn products<T: Number>([shift, roll, yaw]: [[T; 2]; 3]) -> [T; 8] {
    let row = |roll: T, yaw: T| {
        let weight = roll * yaw;
        [shift[0] * weight, shift[1] * weight]
    };
    let ([a, b], [c, d]) = (row(roll[0], yaw[0]), row(roll[1], yaw[0]));
    let ([e, f], [g, h]) = (row(roll[0], yaw[1]), row(roll[1], yaw[1]));
    [a, b, c, d, e, f, g, h]
}

impl<'a> Cell<'a> {
    /// The cell of the pose in one lane.
    #[inline(always)]
    pub(super) fn new<S: Simd>(tables: &'a Tables, poses: &LocatedPoses<S>, lane: usize) -> Self {
        let start = whole(poses.start.lane(lane));
        let [roll_stride, yaw_stride] = tables.strides;
        let row = |offset: usize| {
            let (rows, _) = tables.nodes[start + offset..].as_chunks::<2>();
            &rows[0]
        };
        let rows = [
            row(0),
            row(roll_stride),
            row(yaw_stride),
            row(yaw_stride + roll_stride),
        ];
        let weights = poses.weights.each(|weight| weight.lane(lane));
        Self {
            tables,
            rows,
            weights: poses.single_weights(lane),
            interpenetrations: interpenetrations(poses.yaw.simd, &rows, &weights).into(),
            cells: poses.cells.each(|cell| cell.lane(lane)),
            position: poses.position.each(|position| position.lane(lane)),
            yaw: poses.yaw.lane(lane),
            is_inside: poses.outside_squared.lane(lane) == 0.0,
        }
    }

    /// Interpolates the numbers of several patches in one pass over the nodes.
    #[inline(always)]
    fn numbers_by<const N: usize, S: Simd>(
        &self,
        simd: S,
        weights: &[f32; 8],
        zones: [usize; N],
    ) -> [Quads<S>; N] {
        let [first, nodes @ ..] = nodes(&self.rows);
        let mut sums = zones.each(|zone| {
            let (eight, four) = quads(simd, first, zone);
            (eight * weights[0], four * weights[0])
        });
        for (node, weight) in nodes.into_iter().zip(&weights[1..]) {
            let (eight_weights, four_weights) =
                (simd.splat_f32x8(*weight), simd.splat_f32x4(*weight));
            for (sum, zone) in sums.iter_mut().zip(zones) {
                let (eight, four) = quads(simd, node, zone);
                sum.0 = simd.mul_add_f32x8(eight, eight_weights, sum.0);
                sum.1 = simd.mul_add_f32x4(four, four_weights, sum.1);
            }
        }
        sums
    }
}

#[inline(always)]
fn quads<S: Simd>(simd: S, node: &Node, zone: usize) -> Quads<S> {
    let (eight, four) = node.numbers[zone].split_at(8);
    (
        f32x8::from_slice(simd, eight),
        f32x4::from_slice(simd, four),
    )
}

#[inline(always)]
fn nodes<'a>([a, b, c, d]: &[&'a [Node; 2]; 4]) -> [&'a Node; 8] {
    [&a[0], &a[1], &b[0], &b[1], &c[0], &c[1], &d[0], &d[1]]
}

impl Cell<'_> {
    /// Interpolates the numbers of two patches. Most wheels have one loaded patch, which is then listed twice.
    #[inline(always)]
    fn numbers_of_two<S: Simd>(&self, simd: S, zones: [usize; 2]) -> [Quads<S>; 2] {
        if zones[0] == zones[1] {
            let [numbers] = self.numbers_by(simd, &self.weights, [zones[0]]);
            [numbers; 2]
        } else {
            self.numbers_by(simd, &self.weights, zones)
        }
    }
}

/// The packed numbers of a patch: the first eight, then the last four.
type Quads<S> = (f32x8<S>, f32x4<S>);

fn to_array<S: Simd>((eight, four): Quads<S>) -> [f64; NUMBERS] {
    let ([a, b, c, d, e, f, g, h], [i, j, k, l]) = (eight.to_array(), four.to_array());
    [a, b, c, d, e, f, g, h, i, j, k, l].map(f64::from)
}

#[inline(always)]
fn interpenetrations<S: Simd>(simd: S, rows: &[&[Node; 2]; 4], weights: &[f64; 8]) -> f64x4<S> {
    let [first, nodes @ ..] = nodes(rows);
    let mut sum = load(simd, &first.interpenetrations) * weights[0];
    for (node, weight) in nodes.into_iter().zip(&weights[1..]) {
        let weight = simd.splat_f64x4(*weight);
        sum = simd.mul_add_f64x4(load(simd, &node.interpenetrations), weight, sum);
    }
    sum
}

impl PatchReader for Cell<'_> {
    #[inline(always)]
    fn is_inside(&self) -> bool {
        self.is_inside
    }

    #[inline(always)]
    fn interpenetrations_m(&self) -> [f64; ZONES] {
        self.interpenetrations
    }

    fn numbers(&self, zone: usize) -> PatchNumbers<f64> {
        let numbers = dispatch!(crate::math::level(), simd => {
            to_array(self.numbers_by(simd, &self.weights, [zone])[0])
        });
        PatchNumbers::from_array(numbers)
    }

    #[inline(always)]
    fn numbers_in_lanes<S: Simd>(
        simd: S,
        [left, right]: [&Self; 2],
        [a, b, c, d]: [usize; 4],
    ) -> PatchNumbers<f64x4<S>> {
        let [left_first, left_second] = left.numbers_of_two(simd, [a, c]);
        let [right_first, right_second] = right.numbers_of_two(simd, [b, d]);
        let lanes = [left_first, right_first, left_second, right_second];
        let eight = lanes.each(|(eight, _)| eight.simd.split_f32x8(eight));
        let [p, q, r, s] = transposed(simd, eight.each(|(four, _)| four));
        let [t, u, v, w] = transposed(simd, eight.each(|(_, four)| four));
        let [x, y, z, last] = transposed(simd, lanes.each(|(_, four)| four));
        PatchNumbers::from_array([p, q, r, s, t, u, v, w, x, y, z, last])
    }

    fn slopes(&self, zone: usize) -> [PatchSlopes; 3] {
        dispatch!(crate::math::level(), simd => self.slopes_in(simd, zone))
    }
}

impl Cell<'_> {
    #[inline(always)]
    fn slopes_in<S: Simd>(&self, simd: S, zone: usize) -> [PatchSlopes; 3] {
        let (mut depth, mut numbers) = ([0.0; 3], [[0.0; NUMBERS]; 3]);
        for axis in 0..3 {
            if !self.is_inside {
                break;
            }
            let mut ends = ends(self.position);
            ends[axis] = [-1.0, 1.0];
            let weights = products(ends);
            let interpenetrations = interpenetrations(simd, &self.rows, &weights);
            let weights = weights.each(|weight| weight as f32);
            let [of_zone] = self.numbers_by(simd, &weights, [zone]);
            let cells_per_unit = self.tables.finder.axes[axis].cells_per_unit(self.cells[axis]);
            depth[axis] = interpenetrations[zone] * cells_per_unit;
            numbers[axis] = to_array(of_zone).map(|slope| slope * cells_per_unit);
        }
        // The shift at which the tables are read depends on the yaw too.
        let squared = 2.0 * self.yaw;
        let shift = squared * self.tables.finder.yaw_shift[0];
        let by_yaw =
            |by_shift: f64, by_yaw_squared: f64| shift * by_shift + squared * by_yaw_squared;
        depth[2] = by_yaw(depth[0], depth[2]);
        numbers[2] = from_fn(|n| by_yaw(numbers[0][n], numbers[2][n]));
        [0, 1, 2].map(|axis| PatchSlopes {
            interpenetration: depth[axis],
            numbers: PatchNumbers::from_array(numbers[axis]),
        })
    }
}
