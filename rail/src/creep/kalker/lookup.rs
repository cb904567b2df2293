//! Kalker's coefficients, read without logarithms.

use std::array::from_fn;

use fearless_simd::{Simd, SimdBase, f32x4, f64x4};

use super::{KalkerCoefficients, KalkerTable};
use crate::creep::shape::{ratio, shape};
use crate::math::dual::Dual;
use crate::math::number::{Number, WHOLE, transposed};

/// Number of rows, at equidistant shapes of the ellipse; a power of two.
const ROWS: usize = 512;
/// Greatest magnitude of the shape; the semi-axes then differ by a factor of 400.
const MAX_SHAPE: f64 = 0.99;
/// The last row from which to interpolate.
const LAST: f64 = (ROWS - 2) as f64;

/// Kalker's coefficients at many ratios of the semi-axes.
#[derive(Debug, Clone)]
pub(crate) struct KalkerLookup {
    rows: Box<[Row; ROWS]>,
}

/// The four coefficients at a shape, and their differences to the next row.
#[derive(Debug, Clone, Copy)]
struct Row {
    here: [f32; 4],
    step: [f32; 4],
}

/// Position of an ellipse among the rows.
#[inline(always)]
fn position<T: Number>(a: T, b: T) -> T {
    shape(a, b).limited(MAX_SHAPE) * (0.5 * (ROWS - 1) as f64 / MAX_SHAPE) + 0.5 * (ROWS - 1) as f64
}

impl KalkerLookup {
    pub fn new(table: &KalkerTable) -> Self {
        let row = |row: usize| {
            let part = 2.0 * row as f64 / (ROWS - 1) as f64 - 1.0;
            let ratio = ratio(part * MAX_SHAPE);
            let KalkerCoefficients { c11, c22, c23, c33 } = table.at(ratio);
            [c11, c22, c23, c33].map(|coefficient| coefficient as f32)
        };
        Self::from_rows(row)
    }

    /// Mean of the coefficients of two steels.
    pub fn mean(&self, other: &Self) -> Self {
        let mean = |row: usize| -> [f32; 4] {
            let [one, other] = [self, other].map(|lookup| lookup.rows[row].here);
            from_fn(|k| 0.5 * (one[k] + other[k]))
        };
        Self::from_rows(mean)
    }

    fn from_rows(here: impl Fn(usize) -> [f32; 4]) -> Self {
        let row = |row: usize| {
            let (here, next) = (here(row), here((row + 1).min(ROWS - 1)));
            let step = from_fn(|k| next[k] - here[k]);
            Row { here, step }
        };
        Self {
            rows: Box::new(from_fn(row)),
        }
    }

    /// Coefficients of ellipses with the semi-axes `a` in the rolling direction and `b` across.
    #[inline(always)]
    pub fn at_lanes<S: Simd>(&self, [a, b]: [f64x4<S>; 2]) -> KalkerCoefficients<f64x4<S>> {
        let simd = a.simd;
        let position = position(a, b);
        // The row whose middle is nearest.
        let whole = position + -0.5 + WHOLE;
        let part = position - (whole + -WHOLE);
        let zero = simd.splat_f64x2(0.0);
        let (first, second) = simd.split_f64x4(part);
        let part = simd.combine_f32x4(
            simd.narrow_f64x2(first, zero),
            simd.narrow_f64x2(second, zero),
        );
        let value = |lane: usize, part: f32| {
            let Row { here, step } = &self.rows[whole[lane].to_bits() as usize % ROWS];
            let (here, step) = (f32x4::from_slice(simd, here), f32x4::from_slice(simd, step));
            here + step * simd.splat_f32x4(part)
        };
        let values = [
            value(0, part[0]),
            value(1, part[1]),
            value(2, part[4]),
            value(3, part[5]),
        ];
        let [c11, c22, c23, c33] = transposed(simd, values);
        KalkerCoefficients { c11, c22, c23, c33 }
    }

    /// Coefficients with their derivatives.
    pub fn at_dual<const N: usize>(&self, [a, b]: [Dual<N>; 2]) -> KalkerCoefficients<Dual<N>> {
        let position = position(a, b);
        let row = position.value().min(LAST) as usize;
        let part = position.value() - row as f64;
        let Row { here, step } = &self.rows[row];
        let coefficient = |k: usize| {
            let (here, slope) = (f64::from(here[k]), f64::from(step[k]));
            Dual::function(here + part * slope, [(slope, position)])
        };
        KalkerCoefficients {
            c11: coefficient(0),
            c22: coefficient(1),
            c23: coefficient(2),
            c33: coefficient(3),
        }
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use crate::math::dispatch::dispatch;

    use super::*;
    use crate::math::number::load;

    #[test]
    fn coefficients_are_those_of_the_table() {
        #[inline(always)]
        fn in_lanes<S: Simd>(simd: S, lookup: &KalkerLookup, a: [f64; 4]) -> [[f64; 4]; 4] {
            let at = lookup.at_lanes([load(simd, &a), simd.splat_f64x4(1.0)]);
            [at.c11, at.c22, at.c23, at.c33].map(<[f64; 4]>::from)
        }
        let table = KalkerTable::new(0.28).unwrap();
        let lookup = KalkerLookup::new(&table);
        for ratios in [
            [0.5176, 0.52, 0.6, 0.4],
            [0.01, 0.12, 0.35, 0.9],
            [1.0, 1.7, 6.0, 23.0],
        ] {
            let lanes = dispatch!(Level::new(), simd => in_lanes(simd, &lookup, ratios));
            for (lane, ratio) in ratios.into_iter().enumerate() {
                let exact = table.at(ratio);
                let exact = [exact.c11, exact.c22, exact.c23, exact.c33];
                let axes = [Dual::<1>::variable(ratio, 0), Dual::constant(1.0)];
                let dual = lookup.at_dual(axes);
                let dual = [dual.c11, dual.c22, dual.c23, dual.c33];
                let ahead = table.at(ratio * 1.001);
                let ahead = [ahead.c11, ahead.c22, ahead.c23, ahead.c33];
                // Beyond the book of tables, the coefficients bend within a row.
                let is_in_book = (0.04..=25.0).contains(&ratio);
                for k in 0..4 {
                    let allowed = if is_in_book { 1e-3 } else { 1e-2 };
                    let off = lanes[k][lane] / exact[k] - 1.0;
                    assert!(off.abs() < allowed, "{ratio} {k}: {off}");
                    assert!((dual[k].value() / lanes[k][lane] - 1.0).abs() < 1e-6);
                    if !is_in_book {
                        continue;
                    }
                    let slope = (ahead[k] - exact[k]) / (0.001 * ratio);
                    let error = f64::from(dual[k].derivatives()[0]) - slope;
                    assert!(error.abs() < 0.03 * exact[k] / ratio, "{ratio} {k}");
                }
            }
        }
    }
}
