//! Transposes of four vectors.

use fearless_simd::prelude::*;
#[cfg(target_arch = "x86_64")]
use fearless_simd::x86::{Avx2, Sse2};
use fearless_simd::{f32x4, f32x8, f64x4};

/// Token of vector instructions with transposes. The provided methods suit vectors of 128 bits, of which the types here
/// are pairs.
pub(crate) trait Transposes: Simd {
    /// Transposes the low halves of four vectors, and their high halves.
    #[inline(always)]
    fn transposed_halves(self, [a, b, c, d]: [f32x8<Self>; 4]) -> [f32x8<Self>; 4] {
        let (a, b, c, d) = (a.split(), b.split(), c.split(), d.split());
        let low = transposed([a.0, b.0, c.0, d.0]);
        let high = transposed([a.1, b.1, c.1, d.1]);
        [
            low[0].combine(high[0]),
            low[1].combine(high[1]),
            low[2].combine(high[2]),
            low[3].combine(high[3]),
        ]
    }

    /// Transposes four vectors.
    #[inline(always)]
    fn transposed(self, [a, b, c, d]: [f64x4<Self>; 4]) -> [f64x4<Self>; 4] {
        let (a, b, c, d) = (a.split(), b.split(), c.split(), d.split());
        let (top, top_right) = (a.0.interleave(b.0), a.1.interleave(b.1));
        let (low, low_right) = (c.0.interleave(d.0), c.1.interleave(d.1));
        [
            top.0.combine(low.0),
            top.1.combine(low.1),
            top_right.0.combine(low_right.0),
            top_right.1.combine(low_right.1),
        ]
    }
}

#[inline(always)]
fn transposed<S: Simd>([a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let (even, odd) = (a.interleave(c), b.interleave(d));
    let (first, second) = even.0.interleave(odd.0);
    let (third, last) = even.1.interleave(odd.1);
    [first, second, third, last]
}

#[cfg(target_arch = "aarch64")]
impl Transposes for fearless_simd::aarch64::Neon {}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
impl Transposes for fearless_simd::wasm32::WasmSimd128 {}

#[cfg(target_arch = "x86_64")]
impl Transposes for Sse2 {}

#[cfg(target_arch = "x86_64")]
impl Transposes for Avx2 {
    #[inline(always)]
    fn transposed_halves(self, [a, b, c, d]: [f32x8<Self>; 4]) -> [f32x8<Self>; 4] {
        transposed_halves_avx2(self, a, b, c, d)
    }

    #[inline(always)]
    fn transposed(self, [a, b, c, d]: [f64x4<Self>; 4]) -> [f64x4<Self>; 4] {
        transposed_avx2(self, a, b, c, d)
    }
}

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    /// [`Transposes::transposed_halves`] with the instructions that work on both halves.
    #[inline(always)]
    fn transposed_halves_avx2(
        avx2: Avx2,
        a: f32x8<Avx2>,
        b: f32x8<Avx2>,
        c: f32x8<Avx2>,
        d: f32x8<Avx2>,
    ) -> [f32x8<Avx2>; 4] {
        use core::arch::x86_64::{_mm256_shuffle_ps, _mm256_unpackhi_ps, _mm256_unpacklo_ps};
        let low = _mm256_unpacklo_ps(a.into(), b.into());
        let high = _mm256_unpackhi_ps(a.into(), b.into());
        let low_right = _mm256_unpacklo_ps(c.into(), d.into());
        let high_right = _mm256_unpackhi_ps(c.into(), d.into());
        [
            _mm256_shuffle_ps::<0x44>(low, low_right).simd_into(avx2),
            _mm256_shuffle_ps::<0xEE>(low, low_right).simd_into(avx2),
            _mm256_shuffle_ps::<0x44>(high, high_right).simd_into(avx2),
            _mm256_shuffle_ps::<0xEE>(high, high_right).simd_into(avx2),
        ]
    }
);

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    /// [`Transposes::transposed`] with the instructions that work on whole vectors.
    #[inline(always)]
    fn transposed_avx2(
        avx2: Avx2,
        a: f64x4<Avx2>,
        b: f64x4<Avx2>,
        c: f64x4<Avx2>,
        d: f64x4<Avx2>,
    ) -> [f64x4<Avx2>; 4] {
        use core::arch::x86_64::{_mm256_permute2f128_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd};
        let even = _mm256_unpacklo_pd(a.into(), b.into());
        let odd = _mm256_unpackhi_pd(a.into(), b.into());
        let even_right = _mm256_unpacklo_pd(c.into(), d.into());
        let odd_right = _mm256_unpackhi_pd(c.into(), d.into());
        [
            _mm256_permute2f128_pd::<0x20>(even, even_right).simd_into(avx2),
            _mm256_permute2f128_pd::<0x20>(odd, odd_right).simd_into(avx2),
            _mm256_permute2f128_pd::<0x31>(even, even_right).simd_into(avx2),
            _mm256_permute2f128_pd::<0x31>(odd, odd_right).simd_into(avx2),
        ]
    }
);
