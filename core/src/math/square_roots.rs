//! Square roots of several numbers, with the vector instructions that every processor of the architecture has.

#[cfg(any(
    target_arch = "x86_64",
    target_arch = "aarch64",
    all(target_arch = "wasm32", target_feature = "simd128")
))]
use fearless_simd::{Level, f64x2, prelude::*};

/// Returns the square roots; a vector has the bits of `libm::sqrt`, because IEEE 754 defines square roots exactly.
#[inline(always)]
pub(crate) fn square_roots<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    #[cfg(target_arch = "x86_64")]
    let baseline = Level::baseline().as_sse2();
    #[cfg(target_arch = "aarch64")]
    let baseline = Level::baseline().as_neon();
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    let baseline = Level::baseline().as_wasm_simd128();
    #[cfg(any(
        target_arch = "x86_64",
        target_arch = "aarch64",
        all(target_arch = "wasm32", target_feature = "simd128")
    ))]
    if let Some(baseline) = baseline {
        let mut roots = numbers;
        let (pairs, last) = roots.as_chunks_mut();
        for pair in pairs {
            *pair = f64x2::load_array(baseline, *pair).sqrt().to_array();
        }
        for number in last {
            *number = libm::sqrt(*number);
        }
        return roots;
    }
    numbers.map(libm::sqrt)
}

#[cfg(test)]
mod tests {
    use super::square_roots;

    #[test]
    fn square_roots_together_have_the_bits_of_square_roots_alone() {
        let numbers = [2.0, 1e-300, 3e200, 0.0, 5e-324, f64::MAX, 7.5];
        let expected = numbers.map(|number| libm::sqrt(number).to_bits());
        assert_eq!(square_roots(numbers).map(f64::to_bits), expected);
        assert!(square_roots([-1.0, 4.0])[0].is_nan());
    }
}
