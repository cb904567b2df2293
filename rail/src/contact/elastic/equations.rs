//! The linear equations of strips in contact: coefficients and two right sides.

use fearless_simd::{Bytes, Simd, SimdBase, dispatch, f64x4, u64x4};

use crate::math::each::Each;
use crate::math::number::load;

/// Equations `sum over j of deflection(i, j) load(j) = side(i)` for two right sides.
///
/// The coefficients are stored by columns, each padded to whole vectors; the right sides follow as two more columns.
#[derive(Debug, Clone, Default)]
pub(super) struct Equations {
    count: usize,
    /// Rows with padding.
    rows: usize,
    /// Positions of the strips, m.
    arcs_m: Vec<f64>,
    columns: Vec<f64>,
    multipliers: Vec<f64>,
}

impl Equations {
    /// Begins with strips, each with its position (m) and both right sides.
    pub fn begin(&mut self, strips: impl ExactSizeIterator<Item = [f64; 3]>) {
        self.count = strips.len();
        self.rows = self.count.next_multiple_of(4);
        self.arcs_m.clear();
        self.columns.clear();
        self.columns.resize((self.count + 2) * self.rows, 0.0);
        let (first, second) = (self.count * self.rows, (self.count + 1) * self.rows);
        for (row, [arc_m, at_zero, per_depth]) in strips.enumerate() {
            self.arcs_m.push(arc_m);
            self.columns[first + row] = at_zero;
            self.columns[second + row] = per_depth;
        }
        let last = self.arcs_m.last().copied().unwrap_or(0.0);
        // The padding lies far away.
        self.arcs_m.resize(self.rows, last + 1.0);
    }

    /// Sets the coefficients of strip `column`: `factor` times the deflection at the distance from it, multiplied by
    /// `per_length`; `own` at itself.
    pub fn set_column(&mut self, column: usize, per_length: f64, factor: f64, own: f64) {
        let at = column * self.rows;
        let rows = &mut self.columns[at..at + self.rows];
        let arc_m = self.arcs_m[column];
        dispatch!(crate::math::level(), simd => deflections(simd, rows, &self.arcs_m, [arc_m, per_length, factor]));
        rows[column] = factor * own;
    }

    /// Solves the equations; the solutions replace the right sides.
    ///
    /// Rows are not exchanged: the largest coefficient of each column is the one on the diagonal.
    pub fn solve(&mut self) {
        dispatch!(crate::math::level(), simd => self.eliminate(simd));
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
    fn eliminate<S: Simd>(&mut self, simd: S) {
        let (count, rows) = (self.count, self.rows);
        for pivot in 0..count {
            let (before, after) = self.columns.split_at_mut((pivot + 1) * rows);
            let start = pivot / 4 * 4;
            let column = &before[pivot * rows..];
            let reciprocal = -1.0 / column[pivot];
            self.multipliers.clear();
            let multipliers = column[start..].iter().map(|value| value * reciprocal);
            self.multipliers.extend(multipliers);
            self.multipliers[..=pivot - start].fill(0.0);
            let (multipliers, _) = self.multipliers.as_chunks::<4>();
            for column in after.chunks_exact_mut(rows) {
                let factor = simd.splat_f64x4(column[pivot]);
                let (values, _) = column[start..].as_chunks_mut::<4>();
                for (value, multiplier) in values.iter_mut().zip(multipliers) {
                    let sum: f64x4<S> =
                        simd.mul_add_f64x4(load(simd, multiplier), factor, load(simd, value));
                    sum.store_slice(value);
                }
            }
        }
        let (matrix, sides) = self.columns.split_at_mut(count * rows);
        for side in sides.chunks_exact_mut(rows) {
            for pivot in (0..count).rev() {
                let column = &matrix[pivot * rows..][..rows];
                let value = side[pivot] / column[pivot];
                side[pivot] = value;
                for (sum, coefficient) in side[..pivot].iter_mut().zip(column) {
                    *sum -= value * coefficient;
                }
            }
        }
    }
}

/// Writes `factor G(|arc - own arc| per length)` into `rows`.
#[inline(always)]
fn deflections<S: Simd>(
    simd: S,
    rows: &mut [f64],
    arcs_m: &[f64],
    [own_m, per_length, factor]: [f64; 3],
) {
    let (rows, _) = rows.as_chunks_mut::<4>();
    let (arcs, _) = arcs_m.as_chunks::<4>();
    for (row, arcs) in rows.iter_mut().zip(arcs) {
        let distance = (load(simd, arcs) - own_m) * per_length;
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
    let mut k = 11.0;
    while k > 0.0 {
        series = series * square + 2.0 / k;
        k -= 2.0;
    }
    series * s + exponent * std::f64::consts::LN_2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::elastic::half_space::HalfSpace;

    #[test]
    fn deflections_are_those_of_the_table() {
        for u in [2e-3, 0.01, 0.1, 0.5, 1.0, 3.0, 30.0] {
            let mut equations = Equations::default();
            equations.begin([[0.0, 1.0, 2.0], [u, 1.0, 2.0]].into_iter());
            equations.set_column(0, 1.0, 3.0, 7.0);
            assert_eq!(equations.columns[0], 21.0);
            let ratio = equations.columns[1] / (3.0 * HalfSpace::tables().beside(u));
            assert!((ratio - 1.0).abs() < 2e-4, "{u}: {ratio}");
        }
    }

    #[test]
    fn solutions_satisfy_the_equations() {
        for count in 1..13 {
            let coefficient =
                |i: usize, j: usize| 1.0 / (1.0 + (i as f64 - j as f64).abs()) + 0.01 * j as f64;
            let mut equations = Equations::default();
            equations.begin((0..count).map(|i| [i as f64, i as f64, 1.0]));
            for j in 0..count {
                for i in 0..count {
                    equations.columns[j * equations.rows + i] = coefficient(i, j);
                }
            }
            equations.solve();
            let solutions: Vec<[f64; 2]> = equations.solutions().collect();
            for i in 0..count {
                let sum = |side: usize| -> f64 {
                    (0..count)
                        .map(|j| coefficient(i, j) * solutions[j][side])
                        .sum()
                };
                assert!((sum(0) - i as f64).abs() < 1e-11, "{count}");
                assert!((sum(1) - 1.0).abs() < 1e-11, "{count}");
            }
        }
    }
}
