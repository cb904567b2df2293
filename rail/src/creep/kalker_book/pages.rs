//! Pages of the book: coefficients of a B-spline, and its evaluation.

use std::sync::OnceLock;

use fearless_simd::{Simd, SimdBase, f32x4, f32x8, f64x4};

use crate::creep::shape::ratio;
use crate::math::each::Each;

/// Layout of the file of the book, for programs that write or check it.
///
/// The forces are `f = N(size, spin, direction) / (1 + direction^2)`. `N` is a quadratic B-spline on equal cells,
/// interpolated linearly between the ratios of the semi-axes. Its coefficients belong to the midpoints of the cells,
/// with one more beyond each end. Each coefficient is three little-endian `f32`: longitudinal and lateral force divided
/// by `mu N`, and moment divided by `mu N (a^2 + b^2)/(2 sqrt(a b))`. The direction varies fastest, then spin, size and
/// ratio.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout;

impl Layout {
    /// Number of ratios of the semi-axes, in equal steps of `(a^2 - b^2)/(a^2 + 4 a b + b^2)`, which is approximately a
    /// third of `ln(a/b)`.
    pub const RATIOS: usize = 18;
    /// Number of cells of size, spin and direction.
    pub const CELLS: [usize; 3] = [16, 10, 14];
    /// Maximum ratio of the semi-axes; the minimum is its reciprocal.
    pub const MAX_RATIO: f64 = 25.0;

    /// Ratio `a/b` at an index.
    pub fn a_over_b(index: usize) -> f64 {
        let part = 2.0 * index as f64 / (Self::RATIOS - 1) as f64 - 1.0;
        ratio(part * MAX_SHAPE)
    }
}

/// Value of [`shape`](crate::creep::shape::shape) at the maximum ratio.
pub(super) const MAX_SHAPE: f64 = {
    let ratio = Layout::MAX_RATIO;
    (ratio * ratio - 1.0) / (ratio * ratio + 4.0 * ratio + 1.0)
};

/// Number of coefficients from one spin, size and ratio to the next.
const STRIDE: [usize; 3] = {
    let [size, spin, direction] = Layout::CELLS;
    let row = direction + 2;
    let page = row * (spin + 2);
    [row, page, page * (size + 2)]
};

/// Length of the range of coefficients that one evaluation needs.
const SPAN: usize = 2 * STRIDE[1] + 2 * STRIDE[0] + 3;

/// Coefficients at one ratio and at the next, each `[longitudinal force, lateral force, moment, 0]`.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(super) struct Coefficients([f32; 8]);

const FILE: &[u8] = include_bytes!("../../../data/kalker_book.bin");

/// The coefficients of the book, decoded on first use.
pub(super) fn pages() -> &'static [Coefficients] {
    static PAGES: OnceLock<Vec<Coefficients>> = OnceLock::new();
    PAGES.get_or_init(|| {
        let (numbers, _) = FILE.as_chunks::<4>();
        let (coefficients, _) = numbers.as_chunks::<3>();
        let coefficient = |index: usize| coefficients[index].map(f32::from_le_bytes);
        (0..(Layout::RATIOS - 1) * STRIDE[2])
            .map(|index| {
                let ([x, y, m], [u, v, w]) = (coefficient(index), coefficient(index + STRIDE[2]));
                Coefficients([x, y, m, 0.0, u, v, w, 0.0])
            })
            .collect()
    })
}

/// Number of cells of ratio, size, spin and direction.
const CELLS: [f32; 4] = [
    (Layout::RATIOS - 1) as f32,
    Layout::CELLS[0] as f32,
    Layout::CELLS[1] as f32,
    Layout::CELLS[2] as f32,
];

/// Four positions in Kalker's book of tables, one in each lane.
pub(super) struct BookPositions<S: Simd> {
    /// Indices of the first coefficients.
    first: [u32; 4],
    /// Position of the ratio within its cell, 0 to 1.
    ratio: f32x4<S>,
    /// Positions of size, spin and direction within their cells, 0 to 1.
    at: [f32x4<S>; 3],
    /// Values of the three B-splines on each of these cells.
    weights: [[f32x4<S>; 3]; 3],
}

impl<S: Simd> BookPositions<S> {
    /// Locates four coordinates, all from 0 to 1: ratio of the semi-axes, size, spin and direction.
    #[inline(always)]
    pub(super) fn new(simd: S, [ratio, size, spin, direction]: [f64x4<S>; 4]) -> Self {
        let (ratio_and_size, spin_and_direction) = (
            simd.narrow_f64x4(ratio, size),
            simd.narrow_f64x4(spin, direction),
        );
        let [ratios, sizes, spins, directions] = CELLS;
        let (p, i) = located(
            simd,
            ratio_and_size,
            [ratios, sizes],
            [STRIDE[2], STRIDE[1]],
        );
        let (q, j) = located(
            simd,
            spin_and_direction,
            [spins, directions],
            [STRIDE[0], 1],
        );
        let ([ratio, size], [spin, direction]) = (p, q);
        // Whole numbers below 2^24 are exact.
        let first = simd.cvt_u32_f32x4(i + j).to_array();
        Self {
            first,
            ratio,
            at: [size, spin, direction],
            weights: [size, spin, direction].each(weights),
        }
    }

    /// Evaluates `N` of [`Layout`] in one lane: `[longitudinal force, lateral force, moment, 0]`.
    #[inline(always)]
    pub(super) fn value(&self, pages: &[Coefficients], lane: usize) -> f32x4<S> {
        self.sum(pages, &self.weights, lane)
    }

    /// Evaluates the derivatives of `N` with respect to size, spin and direction in one lane.
    #[inline(always)]
    pub(super) fn gradient(&self, pages: &[Coefficients], lane: usize) -> [f32x4<S>; 3] {
        let mut gradient = [self.ratio; 3];
        for axis in 0..3 {
            let mut factors = self.weights;
            factors[axis] = slopes(self.at[axis]);
            gradient[axis] = self.sum(pages, &factors, lane) * CELLS[axis + 1];
        }
        gradient
    }

    /// Sums the coefficients weighted axis by axis, so that opposite coefficients cancel without rounding.
    #[inline(always)]
    fn sum(&self, pages: &[Coefficients], factors: &[[f32x4<S>; 3]; 3], lane: usize) -> f32x4<S> {
        let simd = self.ratio.simd;
        let near: &[Coefficients; SPAN] = pages[self.first[lane] as usize..]
            .first_chunk()
            .expect("the cells are within the book");
        let [sizes, spins, directions] =
            factors.each(|factor| factor.each(|lanes| simd.splat_f32x8(lanes[lane])));
        let over_spins = [
            over_spins(near, 0, &spins, &directions),
            over_spins(near, STRIDE[1], &spins, &directions),
            over_spins(near, 2 * STRIDE[1], &spins, &directions),
        ];
        let sum = weighted(over_spins, &sizes);
        let (here, next) = simd.split_f32x8(sum);
        here + (next - here) * self.ratio[lane]
    }
}

#[inline(always)]
fn over_spins<S: Simd>(
    near: &[Coefficients; SPAN],
    at: usize,
    spins: &[f32x8<S>; 3],
    directions: &[f32x8<S>; 3],
) -> f32x8<S> {
    let over_directions = [
        over_directions(near, at, directions),
        over_directions(near, at + STRIDE[0], directions),
        over_directions(near, at + 2 * STRIDE[0], directions),
    ];
    weighted(over_directions, spins)
}

#[inline(always)]
fn over_directions<S: Simd>(
    near: &[Coefficients; SPAN],
    at: usize,
    directions: &[f32x8<S>; 3],
) -> f32x8<S> {
    let simd = directions[0].simd;
    let three = [&near[at], &near[at + 1], &near[at + 2]];
    weighted(
        three.each(|one| f32x8::from_slice(simd, &one.0)),
        directions,
    )
}

#[inline(always)]
fn weighted<S: Simd>([a, b, c]: [f32x8<S>; 3], [p, q, r]: &[f32x8<S>; 3]) -> f32x8<S> {
    a * *p + b * *q + c * *r
}

/// Locates two sets of four coordinates. Returns the positions within their cells, 0 to 1, and the sum over both sets
/// of the cell index times the stride.
#[inline(always)]
fn located<S: Simd>(
    simd: S,
    coordinates: f32x8<S>,
    cells: [f32; 2],
    strides: [usize; 2],
) -> ([f32x4<S>; 2], f32x4<S>) {
    let scaled = coordinates * halves(simd, cells);
    let last = halves(simd, cells.each(|cells| cells - 1.0));
    let inside = simd.min_f32x8(simd.max_f32x8(scaled, simd.splat_f32x8(0.0)), last);
    let cell = simd.trunc_f32x8(inside);
    let (first, second) = simd.split_f32x8(scaled - cell);
    let strides = halves(simd, strides.each(|stride| stride as f32));
    let (p, q) = simd.split_f32x8(cell * strides);
    ([first, second], p + q)
}

#[inline(always)]
fn halves<S: Simd>(simd: S, [p, q]: [f32; 2]) -> f32x8<S> {
    f32x8::from_slice(simd, &[p, p, p, p, q, q, q, q])
}

/// Values of the three quadratic B-splines at a position in a cell.
#[inline(always)]
fn weights<S: Simd>(at: f32x4<S>) -> [f32x4<S>; 3] {
    let rest = 1.0 - at;
    [rest * rest * 0.5, at * rest + 0.5, at * at * 0.5]
}

/// Derivatives of [`weights`] with respect to the position in the cell.
#[inline(always)]
fn slopes<S: Simd>(at: f32x4<S>) -> [f32x4<S>; 3] {
    [at - 1.0, 1.0 - at * 2.0, at]
}
