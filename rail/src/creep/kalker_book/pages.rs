//! The book's pages: coefficients of a spline, and the sum over those near a place.

use std::sync::OnceLock;

use wide::f32x4;

/// Layout of the book's file, for what writes and checks it.
///
/// The forces are `f = N(size, spin, direction) / (1 + direction^2)`, where `N` is a quadratic B-spline on equal cells,
/// linear between the ratios of the semi-axes: at coefficients over the middles of the cells, and one more beyond each end.
/// Every coefficient is three little-endian `f32`, longitudinal force, lateral force (over `mu N`) and moment (over
/// `mu N (a^2 + b^2)/(2 sqrt(a b))`); the direction varies fastest, then spin, size and ratio.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Layout;

impl Layout {
    /// Number of ratios of the semi-axes, equal steps of `(a^2 - b^2)/(a^2 + 4 a b + b^2)`, which is
    /// nearly a third of `ln(a/b)`.
    pub const RATIOS: usize = 18;
    /// Cells of size, spin and direction.
    pub const CELLS: [usize; 3] = [16, 10, 14];
    /// Greatest ratio of the semi-axes; the least is its reciprocal.
    pub const GREATEST_RATIO: f64 = 25.0;

    /// Ratio `a/b` at an index.
    pub fn a_over_b(index: usize) -> f64 {
        let part = 2.0 * index as f64 / (Self::RATIOS - 1) as f64 - 1.0;
        let shape = part * GREATEST_SHAPE;
        (2.0 * shape + (1.0 + 3.0 * shape * shape).sqrt()) / (1.0 - shape)
    }
}

/// The number that grows in equal steps, at the greatest ratio.
const GREATEST_SHAPE: f64 = shape(Layout::GREATEST_RATIO, 1.0);

#[inline]
const fn shape(a: f64, b: f64) -> f64 {
    (a * a - b * b) / (a * a + b * b + 4.0 * a * b)
}

/// Coefficients from one spin, size and ratio to the next.
const STRIDE: [usize; 3] = {
    let [size, spin, direction] = Layout::CELLS;
    let row = direction + 2;
    let page = row * (spin + 2);
    [row, page, page * (size + 2)]
};

/// From the first coefficient that a place needs to the last.
const SPAN: usize = STRIDE[2] + 2 * STRIDE[1] + 2 * STRIDE[0] + 3;

/// A coefficient: longitudinal force, lateral force, moment, and zero, which fills a vector register.
pub(super) type Coefficient = f32x4;

const FILE: &[u8] = include_bytes!("../../../data/kalker_book.bin");

/// The book's coefficients, read once.
pub(super) fn pages() -> &'static [Coefficient] {
    static PAGES: OnceLock<Vec<Coefficient>> = OnceLock::new();
    PAGES.get_or_init(|| {
        let (numbers, _) = FILE.as_chunks::<4>();
        let (coefficients, _) = numbers.as_chunks::<3>();
        coefficients
            .iter()
            .map(|three| {
                let [x, y, m] = three.map(f32::from_le_bytes);
                f32x4::from([x, y, m, 0.0])
            })
            .collect()
    })
}

/// The cell of a coordinate from 0 to 1 among `cells`, and the place in it from 0 to 1.
#[inline]
fn cell(coordinate: f64, cells: usize) -> (usize, f32) {
    let scaled = coordinate * cells as f64;
    // Within an i32 the conversion is one instruction.
    let cell = (scaled as i32).clamp(0, cells as i32 - 1);
    (cell as usize, (scaled - f64::from(cell)) as f32)
}

/// Values of the three B-splines over a cell.
#[inline]
fn weights(at: f32) -> [f32; 3] {
    let rest = 1.0 - at;
    [0.5 * rest * rest, 0.5 + at * rest, 0.5 * at * at]
}

/// Their derivatives by the place in the cell.
fn slopes(at: f32) -> [f32; 3] {
    [at - 1.0, 1.0 - 2.0 * at, at]
}

/// The coefficients around a place.
pub(super) struct Near<'a> {
    coefficients: &'a [Coefficient; SPAN],
    ratio: f32,
    /// Place in the cell of size, spin and direction.
    at: [f32; 3],
}

impl<'a> Near<'a> {
    /// Around the ratio of the semi-axes and the coordinates size, spin (0 to 1) and direction (-1 to 1).
    #[inline]
    pub(super) fn new(
        pages: &'a [Coefficient],
        [a, b]: [f64; 2],
        [size, spin, direction]: [f64; 3],
    ) -> Self {
        let shape = (shape(a, b) * (0.5 / GREATEST_SHAPE) + 0.5).clamp(0.0, 1.0);
        let [sizes, spins, directions] = Layout::CELLS;
        let (ratio, ratio_at) = cell(shape, Layout::RATIOS - 1);
        let (size, size_at) = cell(size, sizes);
        let (spin, spin_at) = cell(spin, spins);
        let (direction, direction_at) = cell(0.5 + 0.5 * direction, directions);
        let first = ratio * STRIDE[2] + size * STRIDE[1] + spin * STRIDE[0] + direction;
        let near = pages[first..].first_chunk().expect("cells within the book");
        Self {
            coefficients: near,
            ratio: ratio_at,
            at: [size_at, spin_at, direction_at],
        }
    }

    /// `N` of [`Layout`].
    #[inline]
    pub(super) fn value(&self) -> Coefficient {
        self.sum(self.at.map(weights))
    }

    /// Derivatives of `N` by size, spin and direction.
    pub(super) fn gradient(&self) -> [Coefficient; 3] {
        [0, 1, 2].map(|axis| {
            let mut factors = self.at.map(weights);
            factors[axis] = slopes(self.at[axis]);
            // A direction runs over 2.
            let cells = Layout::CELLS[axis] as f32 * if axis == 2 { 0.5 } else { 1.0 };
            self.sum(factors) * cells
        })
    }

    /// Coefficients weighted axis by axis, so that opposite ones cancel without rounding.
    #[inline(always)]
    fn sum(&self, factors: [[f32; 3]; 3]) -> Coefficient {
        let factors = factors.map(|three| three.map(f32x4::splat));
        let (here, next) = (self.ratio(0, &factors), self.ratio(STRIDE[2], &factors));
        here + (next - here) * self.ratio
    }

    #[inline(always)]
    fn ratio(&self, at: usize, factors: &[[f32x4; 3]; 3]) -> Coefficient {
        self.size(at, factors) * factors[0][0]
            + self.size(at + STRIDE[1], factors) * factors[0][1]
            + self.size(at + 2 * STRIDE[1], factors) * factors[0][2]
    }

    #[inline(always)]
    fn size(&self, at: usize, factors: &[[f32x4; 3]; 3]) -> Coefficient {
        self.spin(at, factors) * factors[1][0]
            + self.spin(at + STRIDE[0], factors) * factors[1][1]
            + self.spin(at + 2 * STRIDE[0], factors) * factors[1][2]
    }

    #[inline(always)]
    fn spin(&self, at: usize, factors: &[[f32x4; 3]; 3]) -> Coefficient {
        let c = self.coefficients;
        c[at] * factors[2][0] + c[at + 1] * factors[2][1] + c[at + 2] * factors[2][2]
    }
}
