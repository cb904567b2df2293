//! Formulas of single coordinates, for all coordinates of all bodies: four numbers at a time.

use fearless_simd::{Simd, SimdBase, f64x4};

use super::block::Vector;
use crate::math::number::Number;

/// Numbers in a vector.
const WIDTH: usize = 4;

/// A formula with `R` operands that replaces `W` numbers.
pub(super) trait Formula<const R: usize, const W: usize> {
    fn at<T: Number>(&self, operands: [T; R], replaced: [T; W]) -> [T; W];
}

/// Applies a formula to every coordinate.
#[inline(always)]
pub(super) fn for_all<S: Simd, const R: usize, const W: usize>(
    simd: S,
    formula: &impl Formula<R, W>,
    operands: [&[Vector]; R],
    replaced: [&mut [Vector]; W],
) {
    let mut operands = operands.map(<[Vector]>::as_flattened);
    let mut replaced = replaced.map(<[Vector]>::as_flattened_mut);
    let lengths = operands.iter().map(|numbers| numbers.len());
    let length = replaced
        .iter()
        .fold(lengths.fold(usize::MAX, usize::min), |length, numbers| {
            length.min(numbers.len())
        });
    // With the same length everywhere, the loops check no bounds.
    for numbers in &mut operands {
        *numbers = &numbers[..length];
    }
    for numbers in &mut replaced {
        *numbers = &mut std::mem::take(numbers)[..length];
    }
    let mut k = 0;
    while k + WIDTH <= length {
        let (mut read, mut old) = ([simd.splat_f64x4(0.0); R], [simd.splat_f64x4(0.0); W]);
        for i in 0..R {
            read[i] = f64x4::from_slice(simd, &operands[i][k..k + WIDTH]);
        }
        for i in 0..W {
            old[i] = f64x4::from_slice(simd, &replaced[i][k..k + WIDTH]);
        }
        let new = formula.at(read, old);
        for i in 0..W {
            new[i].store_slice(&mut replaced[i][k..k + WIDTH]);
        }
        k += WIDTH;
    }
    while k < length {
        let (mut read, mut old) = ([0.0; R], [0.0; W]);
        for i in 0..R {
            read[i] = operands[i][k];
        }
        for i in 0..W {
            old[i] = replaced[i][k];
        }
        let new = formula.at(read, old);
        for i in 0..W {
            replaced[i][k] = new[i];
        }
        k += 1;
    }
}

/// True if the magnitudes of all numbers are below `limit`; false for NaN.
#[inline(always)]
pub(super) fn are_below<S: Simd>(simd: S, numbers: &[Vector], limit: f64) -> bool {
    let (fours, rest) = numbers.as_flattened().as_chunks::<WIDTH>();
    let limits = simd.splat_f64x4(limit);
    let mut below = simd.simd_eq_f64x4(limits, limits);
    for four in fours {
        let magnitudes = simd.abs_f64x4(f64x4::from_slice(simd, four));
        below = simd.and_mask64x4(below, simd.simd_lt_f64x4(magnitudes, limits));
    }
    rest.iter()
        .fold(simd.all_true_mask64x4(below), |below, number| {
            below & (number.abs() < limit)
        })
}

#[cfg(test)]
mod tests {
    use fearless_simd::Level;

    use crate::math::dispatch::dispatch;

    use super::*;

    struct Moved(f64);

    impl Formula<2, 2> for Moved {
        #[inline(always)]
        fn at<T: Number>(&self, [v, a]: [T; 2], [q, sum]: [T; 2]) -> [T; 2] {
            [q + v * self.0, sum + a * v]
        }
    }

    #[test]
    fn a_formula_applies_to_every_coordinate() {
        let vectors = |scale: f64| -> Vec<Vector> {
            let number = |body: usize, i: usize| scale * (7 * body + i) as f64;
            (0..3)
                .map(|body| std::array::from_fn(|i| number(body, i)))
                .collect()
        };
        let (v, a) = (vectors(0.5), vectors(2.0));
        let (mut q, mut sums) = (vectors(1.0), vectors(3.0));
        dispatch!(Level::new(), simd => {
            for_all(simd, &Moved(4.0), [&v, &a], [&mut q, &mut sums]);
        });
        assert_eq!(q, vectors(3.0));
        for (body, sums) in sums.iter().enumerate() {
            for (i, sum) in sums.iter().enumerate() {
                let x = (7 * body + i) as f64;
                assert_eq!(*sum, 3.0 * x + x * x);
            }
        }
    }

    #[test]
    fn every_number_has_to_be_below_the_limit() {
        let below =
            |numbers: &[Vector]| dispatch!(Level::new(), simd => are_below(simd, numbers, 2.0));
        let numbers = [[1.9, -1.9, 0.0, 1.0, -1.0]; 3];
        assert!(below(&numbers));
        for body in 0..3 {
            for i in 0..5 {
                for wrong in [2.0, -2.0, f64::NAN, f64::NEG_INFINITY] {
                    let mut numbers = numbers;
                    numbers[body][i] = wrong;
                    assert!(!below(&numbers), "{body} {i} {wrong}");
                }
            }
        }
    }
}
