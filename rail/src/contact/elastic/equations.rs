//! The linear equations of strips in contact: coefficients and two right sides.

use fearless_simd::{Bytes, Simd, SimdBase, f64x4, u64x4};

use crate::math::dispatch::dispatch;
use crate::math::each::Each;
use crate::math::number::load;

/// Number of columns that are eliminated together, and of rows in a vector.
const BLOCK: usize = 4;
/// For four rows: the factors by which the rows of each pivot of a block are added to them.
type Multipliers = [[f64; BLOCK]; BLOCK];

/// Equations `sum over j of deflection(i, j) load(j) = side(i)` for two right sides.
///
/// The coefficients are stored by columns, each padded to whole vectors; the right sides follow as two more columns.
#[derive(Debug, Clone, Default)]
pub(super) struct Equations {
    count: usize,
    /// Rows with padding.
    rows: usize,
    strips: Vec<LoadedStrip>,
    /// Positions of the strips, m.
    arcs_m: Vec<f64>,
    columns: Vec<f64>,
    multipliers: Vec<Multipliers>,
}

/// A strip in contact: one equation, and one column of coefficients.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadedStrip {
    /// Position, m.
    pub arc_m: f64,
    /// Reciprocal of the half-length, 1/m.
    pub per_length: f64,
    /// Mean of `G` over the own width.
    pub own: f64,
    /// Both right sides.
    pub sides: [f64; 2],
}

impl Equations {
    /// Solves the equations of `strips`, whose deflections are divided by `modulus` and by the half-lengths.
    ///
    /// Rows are not exchanged: the largest coefficient of each column is the one on the diagonal.
    pub fn solve(&mut self, strips: impl ExactSizeIterator<Item = LoadedStrip>, modulus: f64) {
        self.count = strips.len();
        self.rows = self.count.next_multiple_of(BLOCK);
        self.strips.clear();
        self.strips.extend(strips);
        let length = (self.count + 2) * self.rows;
        if self.columns.len() < length {
            self.columns.resize(length, 0.0);
            self.multipliers
                .resize(self.rows / BLOCK, Default::default());
        }
        self.arcs_m.clear();
        let (first, second) = self.columns[self.count * self.rows..].split_at_mut(self.rows);
        for (row, strip) in self.strips.iter().enumerate() {
            self.arcs_m.push(strip.arc_m);
            [first[row], second[row]] = strip.sides;
        }
        first[self.count..].fill(0.0);
        second[self.count..self.rows].fill(0.0);
        let last = self.arcs_m.last().copied().unwrap_or(0.0);
        // The padding lies far away.
        self.arcs_m.resize(self.rows, last + 1.0);
        dispatch!(crate::math::level(), simd => self.fill_and_eliminate(simd, modulus));
    }

    /// Both solutions for each strip.
    pub fn solutions(&self) -> impl Iterator<Item = [f64; 2]> {
        let sides = &self.columns[self.count * self.rows..];
        (0..self.count).map(|row| [sides[row], sides[self.rows + row]])
    }

    /// Sums of both solutions.
    pub fn sums(&self) -> [f64; 2] {
        self.solutions()
            .fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d])
    }

    #[inline(always)]
    fn fill_and_eliminate<S: Simd>(&mut self, simd: S, modulus: f64) {
        if self.count == 0 {
            return;
        }
        let columns = self.columns.chunks_exact_mut(self.rows);
        for (number, (column, strip)) in columns.zip(&self.strips).enumerate() {
            let factor = strip.per_length / modulus;
            deflections(simd, column, &self.arcs_m, strip, factor);
            column[number] = factor * strip.own;
        }
        self.eliminate(simd);
        self.substitute();
    }

    /// Makes the matrix an upper triangle.
    #[inline(always)]
    fn eliminate<S: Simd>(&mut self, simd: S) {
        for start in (0..self.count).step_by(BLOCK) {
            let pivots = BLOCK.min(self.count - start);
            let multipliers = &mut self.multipliers[..(self.rows - start) / BLOCK];
            let columns = &mut self.columns[start * self.rows..(self.count + 2) * self.rows];
            let (block, others) = columns.split_at_mut(pivots * self.rows);
            for (pivot, column) in block.chunks_exact_mut(self.rows).enumerate() {
                let (column, _) = column[start..].as_chunks_mut::<BLOCK>();
                add_pivots(simd, column, multipliers, pivot);
                let reciprocal = -1.0 / column[0][pivot];
                for (multipliers, values) in multipliers.iter_mut().zip(column) {
                    (load(simd, values) * reciprocal).store_slice(&mut multipliers[pivot]);
                }
                multipliers[0][pivot][..=pivot].fill(0.0);
            }
            for column in others.chunks_exact_mut(self.rows) {
                let (column, _) = column[start..].as_chunks_mut::<BLOCK>();
                add_pivots(simd, column, multipliers, pivots);
            }
        }
    }

    /// Solves the triangle; the solutions replace the right sides.
    #[inline(always)]
    fn substitute(&mut self) {
        let (matrix, sides) = self.columns.split_at_mut(self.count * self.rows);
        for side in sides[..2 * self.rows].chunks_exact_mut(self.rows) {
            for pivot in (0..self.count).rev() {
                let column = &matrix[pivot * self.rows..][..self.rows];
                let value = side[pivot] / column[pivot];
                side[pivot] = value;
                for (sum, coefficient) in side[..pivot].iter_mut().zip(column) {
                    *sum -= value * coefficient;
                }
            }
        }
    }
}

/// Adds the rows of the first `pivots` pivots of a block to the rows of `column`, which starts at the block.
#[inline(always)]
fn add_pivots<S: Simd>(
    simd: S,
    column: &mut [[f64; BLOCK]],
    multipliers: &[Multipliers],
    pivots: usize,
) {
    // The first rows give the factors of the pivots one after the other.
    let mut factors = [0.0; BLOCK];
    for pivot in 0..pivots {
        factors[pivot] = column[0][pivot];
        let multiplier = load(simd, &multipliers[0][pivot]);
        let values = load(simd, &column[0]);
        let sum = values + multiplier * simd.splat_f64x4(factors[pivot]);
        sum.store_slice(&mut column[0]);
    }
    let factors = factors.each(|factor| simd.splat_f64x4(factor));
    for (values, multipliers) in column.iter_mut().zip(multipliers).skip(1) {
        let mut sum: f64x4<S> = load(simd, values);
        for (multiplier, factor) in multipliers.iter().zip(factors).take(pivots) {
            sum += load(simd, multiplier) * factor;
        }
        sum.store_slice(values);
    }
}

/// Writes `factor G(|arc - arc of the strip| per length)` into `column`.
#[inline(always)]
fn deflections<S: Simd>(
    simd: S,
    column: &mut [f64],
    arcs_m: &[f64],
    strip: &LoadedStrip,
    factor: f64,
) {
    let (column, _) = column.as_chunks_mut::<BLOCK>();
    let (arcs, _) = arcs_m.as_chunks::<BLOCK>();
    for (row, arcs) in column.iter_mut().zip(arcs) {
        let distance = (load(simd, arcs) - strip.arc_m) * strip.per_length;
        (beside(distance * distance) * factor).store_slice(row);
    }
}

/// Coefficients of the difference `K - E` of the complete elliptic integrals as polynomials of `u^2/(1 + u^2)`: without
/// and with the factor `-ln(u^2/(1 + u^2))` (Abramowitz and Stegun 17.3.34 and 17.3.36; error 4e-8).
const PLAIN: [f64; 5] = [
    1.386_294_361_12 - 1.0,
    0.096_663_442_59 - 0.443_251_414_63,
    0.035_900_923_83 - 0.062_606_012_20,
    0.037_425_637_13 - 0.047_573_835_46,
    0.014_511_962_12 - 0.017_365_064_51,
];
const LOGARITHMIC: [f64; 5] = [
    0.5,
    0.124_985_935_97 - 0.249_983_683_10,
    0.068_802_485_76 - 0.092_001_800_37,
    0.033_283_553_46 - 0.040_696_975_26,
    0.004_417_870_12 - 0.005_264_496_39,
];
/// Least squared distance, in half-lengths; the deflection is infinite at a line of load.
const LEAST: f64 = 1e-8;

/// `G(u)` for four squared distances `u^2`, see [`HalfSpace`](super::half_space::HalfSpace).
#[inline(always)]
fn beside<S: Simd>(square: f64x4<S>) -> f64x4<S> {
    let simd = square.simd;
    let square = square.max(simd.splat_f64x4(LEAST));
    let more = square + 1.0;
    let ratio = square / more;
    let [plain, logarithmic] = [PLAIN, LOGARITHMIC]
        .each(|[a, b, c, d, e]| (((ratio * e + d) * ratio + c) * ratio + b) * ratio + a);
    (plain - logarithmic * logarithm(ratio))
        * simd.sqrt_f64x4(more)
        * std::f64::consts::FRAC_2_PI
        * 2.0
}

/// Coefficients of the series `2 artanh(s)/s` in the square of `s`, from the second highest on.
const ARTANH: [f64; 6] = [2.0 / 11.0, 2.0 / 9.0, 2.0 / 7.0, 2.0 / 5.0, 2.0 / 3.0, 2.0];

/// Natural logarithm of positive numbers, with an error of 2e-7.
#[inline(always)]
fn logarithm<S: Simd>(x: f64x4<S>) -> f64x4<S> {
    /// Bits of 1.0 and of 2^52.
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const WHOLE: u64 = 0x4330_0000_0000_0000;
    let simd = x.simd;
    let bits: u64x4<S> = x.bitcast();
    // The exponent moves into the low bits of 2^52.
    let exponent: f64x4<S> = ((bits >> 52) | WHOLE).bitcast();
    let exponent = exponent - (f64::from_bits(WHOLE) + 1023.0);
    let mantissa: f64x4<S> = ((bits & !(0x7ff << 52)) | ONE).bitcast();
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let square = s * s;
    let mut series = simd.splat_f64x4(2.0 / 13.0);
    for coefficient in ARTANH {
        series = series * square + coefficient;
    }
    series * s + exponent * std::f64::consts::LN_2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::elastic::half_space::HalfSpace;

    fn strip(arc_m: f64, sides: [f64; 2]) -> LoadedStrip {
        LoadedStrip {
            arc_m,
            per_length: 1.0,
            own: 7.0,
            sides,
        }
    }

    #[test]
    fn deflections_are_those_of_the_table() {
        for u in [2e-3, 0.01, 0.1, 0.5, 1.0, 3.0, 30.0] {
            let mut column = [0.0; BLOCK];
            let at = strip(0.0, [0.0; 2]);
            let arcs_m = [u, u, u, u];
            dispatch!(crate::math::level(), simd => deflections(simd, &mut column, &arcs_m, &at, 3.0));
            let ratio = column[0] / (3.0 * HalfSpace::tables().beside(u));
            assert!((ratio - 1.0).abs() < 2e-4, "{u}: {ratio}");
        }
    }

    #[test]
    fn solutions_satisfy_the_equations() {
        for count in 0..23 {
            let strips: Vec<LoadedStrip> = (0..count)
                .map(|i| strip(0.3 * f64::from(i), [f64::from(i), 1.0]))
                .collect();
            let mut equations = Equations::default();
            equations.solve(strips.iter().copied(), 0.5);
            let solutions: Vec<[f64; 2]> = equations.solutions().collect();
            assert_eq!(solutions.len(), strips.len());
            for (i, row) in strips.iter().enumerate() {
                let coefficient = |j: usize| {
                    let u = (row.arc_m - strips[j].arc_m).abs();
                    let tables = HalfSpace::tables();
                    2.0 * if i == j { 7.0 } else { tables.beside(u) }
                };
                for side in 0..2 {
                    let terms = solutions.iter().enumerate();
                    let sum: f64 = terms.map(|(j, load)| coefficient(j) * load[side]).sum();
                    assert!((sum - row.sides[side]).abs() < 2e-3, "{count} {i} {sum}");
                }
            }
        }
    }
}
